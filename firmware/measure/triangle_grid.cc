// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <limits>

#include "firmware/measure/measurement.h"

namespace relievo::firmware::measure {
namespace {

// Ericson, Real-Time Collision Detection (2005), 5.1.5.
Vec3d nearest_on_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d ab = minus(b, a);
  const Vec3d ac = minus(c, a);
  const Vec3d ap = minus(p, a);
  const double d1 = dot(ab, ap);
  const double d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3d bp = minus(p, b);
  const double d3 = dot(ab, bp);
  const double d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return plus(a, times(ab, d1 / (d1 - d3)));
  const Vec3d cp = minus(p, c);
  const double d5 = dot(ab, cp);
  const double d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return plus(a, times(ac, d2 / (d2 - d6)));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    return plus(b, times(minus(c, b), (d4 - d3) / ((d4 - d3) + (d5 - d6))));
  }
  const double whole = va + vb + vc;
  return plus(a, plus(times(ab, vb / whole), times(ac, vc / whole)));
}

constexpr std::size_t kMostCells = 40'000'000;

}  // namespace

TriangleGrid::TriangleGrid(const Surface& surface) : surface_(surface) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  Vec3d low{kInf, kInf, kInf};
  Vec3d high{-kInf, -kInf, -kInf};
  for (const auto& t : surface.triangles) {
    for (const std::uint32_t i : t) {
      const Vec3d v = wide(surface.vertices_mm[i]);
      low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
      high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
  }
  if (surface.triangles.empty()) return;
  const auto cells = [&](double extent) { return int(extent / cell_mm_) + 1; };
  for (;;) {
    nx_ = cells(high.x - low.x);
    ny_ = cells(high.y - low.y);
    nz_ = cells(high.z - low.z);
    if (double(nx_) * ny_ * nz_ < double(kMostCells)) break;
    cell_mm_ *= 1.5;
  }
  origin_mm_ = low;
  triangles_.sort(std::size_t(nx_) * std::size_t(ny_) * std::size_t(nz_), [&](auto&& add) {
    for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
      Cell from{nx_, ny_, nz_};
      Cell to{0, 0, 0};
      for (const std::uint32_t v : surface.triangles[i]) {
        const Cell c = cell_of(wide(surface.vertices_mm[v]));
        from = {std::min(from.x, c.x), std::min(from.y, c.y), std::min(from.z, c.z)};
        to = {std::max(to.x, c.x), std::max(to.y, c.y), std::max(to.z, c.z)};
      }
      for (int z = from.z; z <= to.z; ++z)
        for (int y = from.y; y <= to.y; ++y)
          for (int x = from.x; x <= to.x; ++x) add(index_of({x, y, z}), i);
    }
  });
}

TriangleGrid::Cell TriangleGrid::cell_of(const Vec3d& p) const {
  const auto axis = [this](double at, double origin) {
    return int(std::floor(std::clamp((at - origin) / cell_mm_, -1e6, 1e6)));
  };
  return {axis(p.x, origin_mm_.x), axis(p.y, origin_mm_.y), axis(p.z, origin_mm_.z)};
}

std::size_t TriangleGrid::index_of(const Cell& c) const {
  return (std::size_t(c.z) * std::size_t(ny_) + std::size_t(c.y)) * std::size_t(nx_) + std::size_t(c.x);
}

void TriangleGrid::look(const Cell& cell, const Vec3d& p, Found& found) const {
  if (cell.x < 0 || cell.y < 0 || cell.z < 0 || cell.x >= nx_ || cell.y >= ny_ || cell.z >= nz_) return;
  for (const std::uint32_t i : triangles_[index_of(cell)]) {
    const auto& t = surface_.triangles[i];
    const Vec3d q = nearest_on_triangle(p, wide(surface_.vertices_mm[t[0]]), wide(surface_.vertices_mm[t[1]]),
                                        wide(surface_.vertices_mm[t[2]]));
    const double d = distance(p, q);
    if (d < found.best) found = {d, i, q};
  }
}

void TriangleGrid::look_at_ring(const Cell& c, int ring, const Vec3d& p, Found& found) const {
  for (int z = -ring; z <= ring; ++z) {
    for (int y = -ring; y <= ring; ++y) {
      const bool face = std::abs(z) == ring || std::abs(y) == ring;
      for (int x = -ring; x <= ring; x += face || ring == 0 ? 1 : 2 * ring)
        look({c.x + x, c.y + y, c.z + z}, p, found);
    }
  }
}

std::optional<Nearest> TriangleGrid::nearest(const Vec3d& p, double reach_mm) const {
  if (triangles_.members() == 0) return std::nullopt;
  Found found{reach_mm};
  const Cell centre = cell_of(p);
  // What lies in ring r is at least (r - 1) cells away.
  for (int ring = 0; (ring - 1) * cell_mm_ < found.best; ++ring) look_at_ring(centre, ring, p, found);
  if (!found.which) return std::nullopt;
  const auto& t = surface_.triangles[*found.which];
  const Vec3d a = wide(surface_.vertices_mm[t[0]]);
  const Vec3d n =
      cross(minus(wide(surface_.vertices_mm[t[1]]), a), minus(wide(surface_.vertices_mm[t[2]]), a));
  const double size = length(n);
  return Nearest{found.best, found.at, size > 0 ? times(n, 1 / size) : Vec3d{0, 0, 1}};
}

}  // namespace relievo::firmware::measure

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/head/shape/head_field.h"

#include <unordered_map>

namespace relievo::hal::sim {
namespace {

constexpr int kBlock = 8;  // cells a side that are filled or skipped together
constexpr float kFarOutside = 1e3F, kFarInside = -1e3F;

struct Grid {
  Box box;
  double step;
  int nx, ny, nz;  // samples
  std::vector<float> value;
  std::vector<std::uint8_t> live;  // per block

  Grid(const Box& b, double s) : box(b), step(s) {
    const auto count = [&](double extent) { return (int(std::ceil(extent / s)) / kBlock + 1) * kBlock + 1; };
    nx = count(b.high.x - b.low.x), ny = count(b.high.y - b.low.y), nz = count(b.high.z - b.low.z);
    value.assign(std::size_t(nx) * std::size_t(ny) * std::size_t(nz), kFarOutside);
    live.assign(std::size_t(nx / kBlock) * std::size_t(ny / kBlock) * std::size_t(nz / kBlock), 0);
  }
  std::size_t at(int x, int y, int z) const {
    return (std::size_t(z) * std::size_t(ny) + std::size_t(y)) * std::size_t(nx) + std::size_t(x);
  }
  std::size_t block(int x, int y, int z) const {
    return (std::size_t(z) * std::size_t(ny / kBlock) + std::size_t(y)) * std::size_t(nx / kBlock) +
           std::size_t(x);
  }
  Vec3 place(int x, int y, int z) const { return box.low + Vec3{x * step, y * step, z * step}; }
};

// One slab of blocks. Values on shared faces are computed twice rather than shared between threads.
void fill_slab(Grid& g, const Field& field, int bz) {
  // Half diagonal, and slack for a field that is no true distance.
  const double half = kBlock * g.step / 2, reach = half * 1.75 * 1.35 + 2;
  for (int by = 0; by < g.ny / kBlock; ++by)
    for (int bx = 0; bx < g.nx / kBlock; ++bx) {
      const double centre = field(g.place(bx * kBlock, by * kBlock, bz * kBlock) + Vec3{half, half, half});
      const bool live = std::abs(centre) < reach;
      g.live[g.block(bx, by, bz)] = live ? 1 : 0;
      for (int z = bz * kBlock; z < (bz + 1) * kBlock; ++z)
        for (int y = by * kBlock; y < (by + 1) * kBlock; ++y)
          for (int x = bx * kBlock; x < (bx + 1) * kBlock; ++x)
            g.value[g.at(x, y, z)] =
                live ? float(field(g.place(x, y, z))) : (centre > 0 ? kFarOutside : kFarInside);
    }
}

// Where the surface crosses the cell's edges, on average.
bool cell_point(const Grid& g, int x, int y, int z, Vec3& out) {
  double v[8];
  int inside = 0;
  for (int c = 0; c < 8; ++c) {
    v[c] = double(g.value[g.at(x + (c & 1), y + ((c >> 1) & 1), z + (c >> 2))]);
    inside += v[c] < 0 ? 1 : 0;
  }
  if (inside == 0 || inside == 8) return false;
  Vec3 sum;
  int crossings = 0;
  for (int a = 0; a < 8; ++a)
    for (int axis = 1; axis <= 4; axis *= 2) {
      const int b = a | axis;
      if (b == a || (v[a] < 0) == (v[b] < 0)) continue;
      const double t = v[a] / (v[a] - v[b]);
      const auto corner = [](int c) { return Vec3{double(c & 1), double((c >> 1) & 1), double(c >> 2)}; };
      sum += mix(corner(a), corner(b), std::clamp(t, 0.02, 0.98));
      ++crossings;
    }
  out = g.place(x, y, z) + sum * (g.step / crossings);
  return true;
}

// Every grid edge that changes sign is the middle of a quad of four cells.
void add_quads(const Grid& g, Mesh& mesh, const std::vector<std::int32_t>& index) {
  const std::array<std::size_t, 3> stride{g.at(1, 0, 0), g.at(0, 1, 0), g.at(0, 0, 1)};
  for (int z = 1; z + 2 < g.nz; ++z)
    for (int y = 1; y + 2 < g.ny; ++y)
      for (int x = 1; x + 2 < g.nx; ++x) {
        const std::size_t here = g.at(x, y, z);
        if (index[here] < 0) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const bool in = g.value[here] < 0;
          if (in == (g.value[here + stride[axis]] < 0)) continue;
          const std::size_t u = stride[(axis + 1) % 3], v = stride[(axis + 2) % 3];
          const std::int32_t a = index[here], b = index[here - u], c = index[here - u - v],
                             d = index[here - v];
          if (b < 0 || c < 0 || d < 0) continue;
          const auto corner = [](std::int32_t i) { return std::uint32_t(i); };
          if (in) {
            mesh.triangles.push_back({corner(a), corner(b), corner(c)});
            mesh.triangles.push_back({corner(a), corner(c), corner(d)});
          } else {
            mesh.triangles.push_back({corner(a), corner(c), corner(b)});
            mesh.triangles.push_back({corner(a), corner(d), corner(c)});
          }
        }
      }
}

// Newton's steps along the gradient, kept short: at a sharp seam the gradient jumps.
void settle(Mesh& mesh, std::size_t first, const Field& field, double longest_mm, ThreadPool& pool) {
  const int count = int(mesh.points.size() - first);
  pool.for_each(count, 64, [&](int i) {
    const std::size_t k = first + std::size_t(i);
    Vec3 p = point_of(mesh, k);
    for (int turn = 0; turn < 2; ++turn) {
      constexpr double e = 0.05;
      const double f = field(p);
      const Vec3 slope{(field(p + Vec3{e, 0, 0}) - f) / e, (field(p + Vec3{0, e, 0}) - f) / e,
                       (field(p + Vec3{0, 0, e}) - f) / e};
      const Vec3 step = slope * (-f / std::max(dot(slope, slope), 0.05));
      const double l = length(step);
      p += step * std::min(1.0, longest_mm / std::max(l, 1e-9));
      if (l < 0.01) break;
    }
    mesh.points[k] = to_floats(p);
  });
}

}  // namespace

Mesh mesh_of_field(const Field& field, const Box& box, double step_mm, ThreadPool& pool) {
  Grid grid(box, step_mm);
  const int slabs = grid.nz / kBlock;
  pool.for_each(slabs, slabs, [&](int bz) { fill_slab(grid, field, bz); });
  Mesh mesh;
  std::vector<std::int32_t> index(grid.value.size(), -1);
  for (int z = 0; z + 1 < grid.nz; ++z)
    for (int y = 0; y + 1 < grid.ny; ++y)
      for (int x = 0; x + 1 < grid.nx; ++x) {
        Vec3 p;
        // Slabs are filled one by one, so the last sample plane belongs to no block.
        if (x + 2 >= grid.nx || y + 2 >= grid.ny || z + 2 >= grid.nz ||
            grid.live[grid.block(x / kBlock, y / kBlock, z / kBlock)] == 0)
          continue;
        if (!cell_point(grid, x, y, z, p)) continue;
        index[grid.at(x, y, z)] = std::int32_t(mesh.points.size());
        mesh.points.push_back(to_floats(p));
      }
  add_quads(grid, mesh, index);
  settle(mesh, 0, field, step_mm * 0.5, pool);
  return mesh;
}

void refine(Mesh& mesh, const Field& field, const std::function<bool(Vec3)>& wanted, ThreadPool& pool) {
  std::vector<bool> in(mesh.points.size());
  for (std::size_t i = 0; i < in.size(); ++i) in[i] = wanted(point_of(mesh, i));
  const std::size_t first = mesh.points.size();
  std::unordered_map<std::uint64_t, std::uint32_t> middle;
  middle.reserve(first * 2);
  double longest = 0;
  const auto split = [&](std::uint32_t a, std::uint32_t b) -> std::int64_t {
    if (!in[a] || !in[b]) return -1;
    const std::uint64_t key = std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
    const auto [place, fresh] = middle.try_emplace(key, std::uint32_t(mesh.points.size()));
    if (fresh) {
      const Vec3 p = point_of(mesh, a), q = point_of(mesh, b);
      longest = std::max(longest, length(p - q));
      mesh.points.push_back(to_floats(mix(p, q, 0.5)));
    }
    return place->second;
  };
  std::vector<std::array<std::uint32_t, 3>> out;
  out.reserve(mesh.triangles.size() * 3);
  for (const auto& t : mesh.triangles) {
    const std::array<std::int64_t, 3> m{split(t[0], t[1]), split(t[1], t[2]), split(t[2], t[0])};
    const int cuts = int(m[0] >= 0) + int(m[1] >= 0) + int(m[2] >= 0);
    const auto id = [&](std::size_t k) { return std::uint32_t(m[k]); };
    if (cuts == 3) {
      out.insert(out.end(),
                 {{t[0], id(0), id(2)}, {t[1], id(1), id(0)}, {t[2], id(2), id(1)}, {id(0), id(1), id(2)}});
    } else if (cuts == 1) {  // all three corners inside cut all three edges, so two cuts cannot happen
      const std::size_t k = m[0] >= 0 ? 0 : m[1] >= 0 ? 1 : 2;
      out.insert(out.end(), {{t[k], id(k), t[(k + 2) % 3]}, {id(k), t[(k + 1) % 3], t[(k + 2) % 3]}});
    } else {
      out.push_back(t);
    }
  }
  mesh.triangles = std::move(out);
  settle(mesh, first, field, longest * 0.4, pool);
}

std::vector<Vec3> smooth_normals(const Mesh& mesh) {
  std::vector<Vec3> normals(mesh.points.size());
  for (const auto& t : mesh.triangles) {
    const Vec3 a = point_of(mesh, t[0]), b = point_of(mesh, t[1]), c = point_of(mesh, t[2]);
    const Vec3 n = cross(b - a, c - a);
    for (const std::uint32_t i : t) normals[i] += n;
  }
  for (Vec3& n : normals) n = normalised(n);
  return normals;
}

}  // namespace relievo::hal::sim

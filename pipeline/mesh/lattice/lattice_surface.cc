// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/lattice/lattice_surface.h"

namespace relievo::pipeline {
namespace {

constexpr float kLargestPixel = 100'000;  // beyond this a pixel is a mistake, not a picture

bool usable(const CloudPoint& p) {
  return std::isfinite(p.at_mm.x) && std::isfinite(p.at_mm.y) && p.at_mm.z > 0 && std::isfinite(p.at_mm.z) &&
         std::isfinite(p.sigma_mm) && p.sigma_mm >= 0 && std::abs(p.left_px.x) < kLargestPixel &&
         std::abs(p.left_px.y) < kLargestPixel;
}

struct Box {
  float left = kLargestPixel, top = kLargestPixel, right = -kLargestPixel, bottom = -kLargestPixel;
};

Box bounds(const PointCloud& cloud) {
  Box box;
  for (const CloudPoint& p : cloud.points) {
    if (!usable(p)) continue;
    box.left = std::min(box.left, p.left_px.x);
    box.right = std::max(box.right, p.left_px.x);
    box.top = std::min(box.top, p.left_px.y);
    box.bottom = std::max(box.bottom, p.left_px.y);
  }
  return box;
}

// Mean distance across the line of sight of neighbours so many columns and rows apart.
float usual_distance(const PointLattice& l, int dx, int dy) {
  double sum = 0;
  double count = 0;
  for (int r = 0; r + dy < l.rows; ++r)
    for (int c = 0; c + dx < l.columns; ++c) {
      const std::size_t a = l.index(c, r);
      const std::size_t b = l.index(c + dx, r + dy);
      if (l.node[a] == Node::Empty || l.node[b] == Node::Empty) continue;
      sum += double(edge_between(l.at_mm[a], l.at_mm[b]).across_mm);
      count += 1;
    }
  return count > 0 ? float(sum / count) : 0;
}

// Tests whether two neighbours continue one surface. A depth step is not known by its size alone: the
// flank of a nose is as steep as a small step. It is known by leaving the slope found on both sides.
struct EdgeTest {
  const PointLattice& lattice;
  const LatticeLimits& limits;

  bool joined(int column, int row, int dx, int dy) const {
    const std::size_t a = lattice.index(column, row);
    const std::size_t b = lattice.index(column + dx, row + dy);
    if (lattice.node[a] == Node::Empty || lattice.node[b] == Node::Empty) return false;
    const ViewEdge edge = edge_between(lattice.at_mm[a], lattice.at_mm[b]);
    const float noise = limits.step_sigmas * std::sqrt(lattice.sigma_mm[a] * lattice.sigma_mm[a] +
                                                       lattice.sigma_mm[b] * lattice.sigma_mm[b]);
    const float depth = std::abs(edge.depth_mm);
    // Noise may excuse a slope, but never more than doubles what is allowed: a large sigma is no
    // licence to bridge a gap.
    const float steepest = limits.max_slope * edge.across_mm;
    if (depth > steepest + std::min(noise, steepest)) return false;
    if (depth <= limits.min_step_mm + noise) return true;
    const float before = slope_behind(column, row, -dx, -dy, a);
    const float after = slope_behind(column + dx, row + dy, dx, dy, b);
    const float usual = std::max({before, after, 1.0F}) * edge.across_mm;
    return depth <= limits.step_slope_ratio * usual + noise;
  }

  // The slope from node `k` at (column, row) one step further outwards; 0 where nothing is there.
  float slope_behind(int column, int row, int dx, int dy, std::size_t k) const {
    const int c = column + dx;
    const int r = row + dy;
    if (!lattice.inside(c, r)) return 0;
    const std::size_t n = lattice.index(c, r);
    if (lattice.node[n] == Node::Empty) return 0;
    const ViewEdge edge = edge_between(lattice.at_mm[k], lattice.at_mm[n]);
    const float slope = std::abs(edge.depth_mm) / edge.across_mm;
    return slope > limits.max_slope ? 0 : slope;  // beyond the limit it is another surface
  }
};

struct CellEdges {
  bool top, bottom, left, right, falling, rising;
};

std::uint8_t cut_cell(const PointLattice& l, int c, int r, const CellEdges& e, float min_cosine) {
  const Vec3f& a = l.at_mm[l.index(c, r)];
  const Vec3f& b = l.at_mm[l.index(c + 1, r)];
  const Vec3f& d = l.at_mm[l.index(c + 1, r + 1)];
  const Vec3f& o = l.at_mm[l.index(c, r + 1)];
  std::uint8_t falling = 0;
  std::uint8_t rising = 0;
  if (e.falling && e.left && e.bottom && facing(a, o, d, min_cosine)) falling |= kUnder;
  if (e.falling && e.top && e.right && facing(a, d, b, min_cosine)) falling |= kOver;
  if (e.rising && e.top && e.left && facing(a, o, b, min_cosine)) rising |= kLeft;
  if (e.rising && e.bottom && e.right && facing(b, o, d, min_cosine)) rising |= kRight;
  if (triangle_count(falling) != triangle_count(rising))
    return triangle_count(falling) > triangle_count(rising) ? falling : rising;
  return squared_distance(a, d) <= squared_distance(b, o) ? falling : rising;
}

}  // namespace

void measure_cells(PointLattice& lattice) {
  lattice.cell_width_mm = usual_distance(lattice, 1, 0);
  lattice.cell_height_mm = usual_distance(lattice, 0, 1);
}

PointLattice make_lattice(const PointCloud& cloud, std::pmr::memory_resource* memory) {
  PointLattice lattice(memory);
  if (cloud.lattice_step_px <= 0) return lattice;
  const Box box = bounds(cloud);
  if (box.right < box.left) return lattice;

  const float step = float(cloud.lattice_step_px);
  const auto steps = [step](float from, float to) { return int(std::lround((to - from) / step)); };
  lattice.lay_out(steps(box.left, box.right) + 1, steps(box.top, box.bottom) + 1);
  for (const CloudPoint& p : cloud.points) {
    if (!usable(p)) continue;
    const std::size_t k = lattice.index(steps(box.left, p.left_px.x), steps(box.top, p.left_px.y));
    if (lattice.node[k] != Node::Empty && lattice.sigma_mm[k] <= p.sigma_mm) continue;
    lattice.node[k] = Node::Measured;
    lattice.at_mm[k] = p.at_mm;
    lattice.sigma_mm[k] = p.sigma_mm;
  }
  measure_cells(lattice);
  return lattice;
}

void join_neighbours(PointLattice& l, const LatticeLimits& limits, std::pmr::memory_resource* memory) {
  l.cells.assign(l.size(), 0);
  std::pmr::vector<std::uint8_t> right(l.size(), 0, memory);  // edge (c, r) to (c + 1, r)
  std::pmr::vector<std::uint8_t> down(l.size(), 0, memory);
  const EdgeTest test{l, limits};
  for (int r = 0; r < l.rows; ++r) {
    for (int c = 0; c < l.columns; ++c) {
      if (c + 1 < l.columns) right[l.index(c, r)] = test.joined(c, r, 1, 0);
      if (r + 1 < l.rows) down[l.index(c, r)] = test.joined(c, r, 0, 1);
    }
  }
  const float min_cosine = cosine_of_slope(limits.max_slope);
  for (int r = 0; r + 1 < l.rows; ++r) {
    for (int c = 0; c + 1 < l.columns; ++c) {
      const std::size_t k = l.index(c, r);
      CellEdges e{right[k] != 0, right[l.index(c, r + 1)] != 0, down[k] != 0, down[k + 1] != 0, false, false};
      if (e.top + e.bottom + e.left + e.right < 2) continue;
      // With all four sides joined the corners are one surface and either diagonal will do.
      const bool whole = e.top && e.bottom && e.left && e.right;
      e.falling = whole || test.joined(c, r, 1, 1);
      e.rising = whole || test.joined(c + 1, r, -1, 1);
      l.cells[k] = cut_cell(l, c, r, e, min_cosine);
    }
  }
}

bool facing(const Vec3f& a, const Vec3f& b, const Vec3f& c, float min_cosine) {
  const Vec3f n = cross(minus(b, a), minus(c, a));
  const Vec3f sight = plus(plus(a, b), c);
  const float towards = -dot(n, sight);
  return towards > 0 && towards * towards >= min_cosine * min_cosine * dot(n, n) * dot(sight, sight);
}

std::uint8_t best_cut(const PointLattice& l, std::size_t k, float max_slope) {
  const float min_cosine = cosine_of_slope(max_slope);
  const Vec3f* p = &l.at_mm[k];
  const Vec3f* q = p + l.columns;
  const bool falling = facing(p[0], q[0], q[1], min_cosine) && facing(p[0], q[1], p[1], min_cosine);
  const bool rising = facing(p[0], q[0], p[1], min_cosine) && facing(p[1], q[0], q[1], min_cosine);
  if (!falling && !rising) return 0;
  const bool shorter = squared_distance(p[0], q[1]) <= squared_distance(p[1], q[0]);
  return falling && (shorter || !rising) ? kFalling : kRising;
}

bool carries_surface(const PointLattice& l, int c, int r) {
  const auto cell = [&](int x, int y) { return l.inside(x, y) ? l.cells[l.index(x, y)] : std::uint8_t{0}; };
  return (cell(c, r) & (kUnder | kOver | kLeft)) || (cell(c - 1, r) & (kOver | kLeft | kRight)) ||
         (cell(c - 1, r - 1) & (kUnder | kOver | kRight)) || (cell(c, r - 1) & (kUnder | kLeft | kRight));
}

}  // namespace relievo::pipeline

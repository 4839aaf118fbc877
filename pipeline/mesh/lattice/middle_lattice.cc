// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/lattice/middle_lattice.h"

#include <algorithm>
#include <cmath>

#include "pipeline/mesh/lattice/cubic_weights.h"
#include "pipeline/mesh/vector_math.h"

namespace relievo::pipeline {
namespace {

using mesh::plus, mesh::times;

Vec3d seen_from(const MiddleView& view, const Vec3f& p) {
  return {static_cast<double>(p.x) - view.at_mm.x, static_cast<double>(p.y) - view.at_mm.y, static_cast<double>(p.z) - view.at_mm.z};
}

// The column of every node in the new view, in steps of the lattice.
std::pmr::vector<float> columns_of(const PointLattice& left, const MiddleView& view, std::pmr::memory_resource* memory) {
  std::pmr::vector<float> column(left.size(), 0.0F, memory);
  for (std::size_t k = 0; k < left.size(); ++k)
    if (left.node[k] != Node::Empty) column[k] = static_cast<float>(view.project(seen_from(view, left.at_mm[k])).x) / left.step_px;
  return column;
}

class Row {
 public:
  Row(const PointLattice& left, const LatticeLimits& limits, int row) : left_(left), limits_(limits), row_(row) {}

  // `t` of the way from a node to its right neighbour, which it continues.
  Vec3f point(int column, float t) const {
    const Vec3f& a = left_.at_mm[left_.index(column, row_)];
    const Vec3f& b = left_.at_mm[left_.index(column + 1, row_)];
    if (!joined(column - 1) || !joined(column + 1)) return plus(times(a, 1 - t), times(b, t));
    const std::array<float, 4> w = cubic_weights(t);
    const Vec3f& before = left_.at_mm[left_.index(column - 1, row_)];
    const Vec3f& after = left_.at_mm[left_.index(column + 2, row_)];
    return plus(plus(times(before, w[0]), times(a, w[1])), plus(times(b, w[2]), times(after, w[3])));
  }
  float sigma(int column, float t) const {
    return (1 - t) * left_.sigma_mm[left_.index(column, row_)] + t * left_.sigma_mm[left_.index(column + 1, row_)];
  }
  bool joined(int column) const { return column >= 0 && column + 1 < left_.columns && continues(left_, limits_, column, row_, 1, 0); }

 private:
  const PointLattice& left_;
  const LatticeLimits& limits_;
  int row_;
};

}  // namespace

PointLattice lay_in_middle_view(const PointLattice& left, const MiddleView& view, const LatticeLimits& limits, float margin_mm,
                                std::pmr::memory_resource* memory) {
  PointLattice made(memory);
  const std::pmr::vector<float> column = columns_of(left, view, memory);
  float least = 1e9F;
  float most = -1e9F;
  for (std::size_t k = 0; k < left.size(); ++k) {
    if (left.node[k] == Node::Empty) continue;
    least = std::min(least, column[k]);
    most = std::max(most, column[k]);
  }
  if (most < least || !(left.cell_width_mm > 0 && left.cell_height_mm > 0)) return made;
  const int beside = static_cast<int>(std::ceil(margin_mm / left.cell_width_mm));
  const int above = static_cast<int>(std::ceil(margin_mm / left.cell_height_mm));
  const int first = static_cast<int>(std::floor(least)) - beside;
  made.columns = static_cast<int>(std::ceil(most)) - first + 1 + beside;
  made.rows = left.rows + 2 * above;
  made.view = view;
  made.step_px = left.step_px;
  made.first_px = {static_cast<float>(first) * left.step_px, left.first_px.y - static_cast<float>(above) * left.step_px};
  const std::size_t nodes = static_cast<std::size_t>(made.columns) * static_cast<std::size_t>(made.rows);
  made.node.assign(nodes, Node::Empty);
  made.at_mm.assign(nodes, Vec3f{});
  made.sigma_mm.assign(nodes, 0.0F);
  const Vec3f here{static_cast<float>(view.at_mm.x), static_cast<float>(view.at_mm.y), static_cast<float>(view.at_mm.z)};
  for (int r = 0; r < left.rows; ++r) {
    const Row row(left, limits, r);
    for (int c = 0; c + 1 < left.columns; ++c) {
      if (left.node[left.index(c, r)] == Node::Empty || !row.joined(c)) continue;
      const float from = column[left.index(c, r)];
      const float to = column[left.index(c + 1, r)];
      if (!(to > from)) continue;  // it turns away
      for (int u = static_cast<int>(std::ceil(from)); u <= static_cast<int>(std::floor(to)); ++u) {
        const float t = (static_cast<float>(u) - from) / (to - from);
        const std::size_t k = made.index(u - first, r + above);
        const Vec3f at = mesh::minus(row.point(c, t), here);
        if (made.node[k] != Node::Empty && mesh::dot(made.at_mm[k], made.at_mm[k]) <= mesh::dot(at, at)) continue;
        made.node[k] = Node::Measured;
        made.at_mm[k] = at;
        made.sigma_mm[k] = row.sigma(c, t);
      }
    }
  }
  measure_cells(made);
  return made;
}

}  // namespace relievo::pipeline

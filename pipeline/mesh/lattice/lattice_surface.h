// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which triangles each cell of a lattice carries. Cell (c, r) lies between the nodes (c, r) and (c + 1, r +
// 1); a bit per triangle, two ways to cut the cell:
//
//   falling:  a--b   kUnder = a d c, kOver  = a b d        rising:  a--b   kLeft = a b c, kRight = b d c
//             | \|                                                  | /|
//             c--d                                                  c--d
//
// A surface of cells is planar in the picture, so no edge can carry more than two triangles.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

#include "pipeline/mesh/lattice/head_chart.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/point_cloud.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {

// PointLattice: measured points laid back on the pixel lattice of a rectified view, so that neighbours are
// found by counting, or laid on a head's chart. Columns run right, rows down, as the camera at the origin
// sees it: the left one, or on a chart one within the head. Axes: the left camera's. Millimetres.
enum class Node : std::uint8_t { Empty, Measured, Filled };

struct PointLattice {
  explicit PointLattice(std::pmr::memory_resource* memory)
      : at_mm(memory), sigma_mm(memory), node(memory), cells(memory) {}
  int columns = 0;
  int rows = 0;
  std::optional<HeadChart> chart;  // whose lattice it is, where it is one's: then every node lies on its own
                                   // ray from the chart's centre
  Vec2d first_mm;                  // where node (0, 0) stands on the chart, and how far its neighbours
  double step_mm = 1;
  // A cell as the camera sees it, across the line of sight: the usual distance of neighbours in a row
  // and in a column. 0 where nothing has a neighbour.
  float cell_width_mm = 0;
  float cell_height_mm = 0;
  // columns * rows values each, row by row.
  std::pmr::vector<Vec3f> at_mm;
  std::pmr::vector<float> sigma_mm;  // along the line of sight
  std::pmr::vector<Node> node;
  std::pmr::vector<std::uint8_t> cells;  // the surface, once they are joined; last column and row empty

  std::size_t size() const { return node.size(); }
  std::size_t index(int column, int row) const {
    return std::size_t(row) * std::size_t(columns) + std::size_t(column);
  }
  double radius_mm(std::size_t k) const { return double(length(at_mm[k])); }
  // Where a chart's node stands at that distance from its centre.
  Vec3f on_ray(std::size_t k, double radius_mm) const {
    const auto w = std::size_t(columns);
    return chart->at({first_mm.x + step_mm * double(k % w), first_mm.y + step_mm * double(k / w)}, radius_mm);
  }
  void lay_out(int all_columns, int all_rows) {  // of empty nodes
    columns = all_columns;
    rows = all_rows;
    const std::size_t nodes = std::size_t(columns) * std::size_t(rows);
    node.assign(nodes, Node::Empty);
    at_mm.assign(nodes, Vec3f{});
    sigma_mm.assign(nodes, 0.0F);
  }
  bool inside(int column, int row) const { return column >= 0 && row >= 0 && column < columns && row < rows; }
  // No cell begins at a node of the last column or row.
  bool is_cell(std::size_t k) const { return inside(int(k) % columns + 1, int(k) / columns + 1); }
};

// An edge as the camera at the origin sees it: how far it leads along the line of sight and how far across.
// Their ratio is the surface's slope in that direction.
struct ViewEdge {
  float depth_mm, across_mm;
};
inline ViewEdge edge_between(const Vec3f& from, const Vec3f& to) {
  const Vec3f e = minus(to, from);
  const float depth = dot(e, unit(plus(from, to)));
  return {depth, std::sqrt(std::max(dot(e, e) - depth * depth, 1e-12F))};
}

// Sets the size of a cell by the nodes there are.
void measure_cells(PointLattice& lattice);

// Points that are not finite are left out; where two fall on one node the more certain one stays. An empty
// lattice where no point is usable. Throws std::bad_alloc when `memory` is used up.
PointLattice make_lattice(const PointCloud& cloud, std::pmr::memory_resource* memory);

inline constexpr std::uint8_t kUnder = 1, kOver = 2, kLeft = 4, kRight = 8;
inline constexpr std::uint8_t kFalling = kUnder | kOver, kRising = kLeft | kRight;

// What surface may be (grid_mesher.h has the options they come from): its steps, the gaps in it that are
// closed, its outline.
struct LatticeLimits {
  float max_slope = 0;  // tangent of the steepest angle of incidence
  float step_sigmas = 0;
  float step_slope_ratio = 0;
  float min_step_mm = 0;
  float max_gap_mm = 0;  // from rim to rim
  float max_bend = 0;  // tangent of how far a bridge's slope may leave that of both sides by over min_step_mm
  float max_rim_slope = 0;  // tangent of the steepest angle of incidence before the outside, seen from:
  Vec3f rim_from_mm{};
  float min_width_mm = 0;
  float wave_mm = 0;                  // sigma of the outline's straightening
  float outline_mm = 0, rims_mm = 0;  // sigmas of the lines' smoothing; 0 leaves that line on the lattice
};

// Nodes of every triangle, counter-clockwise as the camera at the origin sees them.
template <typename Visit>
void for_each_triangle(const PointLattice& lattice, Visit&& visit) {
  const std::uint32_t w = std::uint32_t(lattice.columns);
  for (std::uint32_t a = 0; a < lattice.cells.size(); ++a) {
    const std::uint8_t cell = lattice.cells[a];
    if (cell & kUnder) visit(Triangle{a, a + w, a + w + 1});
    if (cell & kOver) visit(Triangle{a, a + w + 1, a + 1});
    if (cell & kLeft) visit(Triangle{a, a + w, a + 1});
    if (cell & kRight) visit(Triangle{a + 1, a + w, a + w + 1});
  }
}

inline int triangle_count(std::uint8_t cell) {
  return cell == 0 ? 0 : (cell == kFalling || cell == kRising) ? 2 : 1;
}

// Cuts every cell whose nodes continue one surface, along the shorter diagonal.
void join_neighbours(PointLattice& lattice, const LatticeLimits& limits, std::pmr::memory_resource* memory);

// Counter-clockwise seen from the camera, and no steeper than the angle of incidence with this cosine.
bool facing(const Vec3f& a, const Vec3f& b, const Vec3f& c, float min_cosine);
inline float cosine_of_slope(float slope) { return 1 / std::sqrt(1 + slope * slope); }

// The better way to cut the cell at index `k` whole, or 0 where either leaves a triangle steeper than
// `max_slope` or turned away.
std::uint8_t best_cut(const PointLattice& lattice, std::size_t k, float max_slope);

// Whether any triangle holds the node (column, row).
bool carries_surface(const PointLattice& lattice, int column, int row);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LatticeSurface: which triangles each cell of a lattice carries. Cell (c, r) lies between the nodes
// (c, r) and (c + 1, r + 1); a bit per triangle, two ways to cut the cell:
//
//   falling:  a--b   kUnder = a d c, kOver  = a b d        rising:  a--b   kLeft = a b c, kRight = b d c
//             | \|                                                  | /|
//             c--d                                                  c--d
//
// A surface of cells is planar in the picture, so no edge can carry more than two triangles.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

#include "pipeline/mesh/lattice/head_chart.h"
#include "pipeline/model/point_cloud.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {

// PointLattice: measured points laid back on the pixel lattice of a rectified view, so that neighbours are
// found by counting, or laid on a head's chart. Columns run right, rows down, as the camera at the origin
// sees it: the left one, or on a chart one within the head. Axes: the left camera's. Millimetres.
enum class Node : std::uint8_t { Empty, Measured, Filled };

struct PointLattice {
  explicit PointLattice(std::pmr::memory_resource* memory) : at_mm(memory), sigma_mm(memory), node(memory) {}
  PointLattice(const PointLattice& other, std::pmr::memory_resource* memory)
      : columns(other.columns),
        rows(other.rows),
        chart(other.chart),
        first_mm(other.first_mm),
        step_mm(other.step_mm),
        cell_width_mm(other.cell_width_mm),
        cell_height_mm(other.cell_height_mm),
        at_mm(other.at_mm, memory),
        sigma_mm(other.sigma_mm, memory),
        node(other.node, memory) {}
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
  bool inside(int column, int row) const { return column >= 0 && row >= 0 && column < columns && row < rows; }
};

// Sets the size of a cell by the nodes there are.
void measure_cells(PointLattice& lattice);

// Points that are not finite are left out; where two fall on one node the more certain one stays. An empty
// lattice where no point is usable. Throws std::bad_alloc when `memory` is used up.
PointLattice make_lattice(const PointCloud& cloud, std::pmr::memory_resource* memory);

inline constexpr std::uint8_t kUnder = 1, kOver = 2, kLeft = 4, kRight = 8;
inline constexpr std::uint8_t kFalling = kUnder | kOver, kRising = kLeft | kRight;

struct LatticeLimits {
  float max_slope = 0;  // tangent of the steepest angle of incidence
  float step_sigmas = 0;
  float step_slope_ratio = 0;
  float min_step_mm = 0;
};

struct LatticeSurface {
  explicit LatticeSurface(std::pmr::memory_resource* memory) : cells(memory) {}
  std::pmr::vector<std::uint8_t> cells;  // as many as the lattice has nodes; last column and row empty
};

// Nodes of every triangle, counter-clockwise as the camera at the origin sees them.
template <typename Visit>
void for_each_triangle(const PointLattice& lattice, const LatticeSurface& surface, Visit&& visit) {
  const std::uint32_t w = std::uint32_t(lattice.columns);
  for (std::uint32_t a = 0; a < surface.cells.size(); ++a) {
    const std::uint8_t cell = surface.cells[a];
    if (cell & kUnder) visit(std::array<std::uint32_t, 3>{a, a + w, a + w + 1});
    if (cell & kOver) visit(std::array<std::uint32_t, 3>{a, a + w + 1, a + 1});
    if (cell & kLeft) visit(std::array<std::uint32_t, 3>{a, a + w, a + 1});
    if (cell & kRight) visit(std::array<std::uint32_t, 3>{a + 1, a + w, a + w + 1});
  }
}

inline int triangle_count(std::uint8_t cell) {
  return cell == 0 ? 0 : (cell == kFalling || cell == kRising) ? 2 : 1;
}

// Whether the node (column, row) and its neighbour (column + dx, row + dy) continue one surface.
bool continues(const PointLattice& lattice, const LatticeLimits& limits, int column, int row, int dx, int dy);

// Cuts every cell whose nodes continue one surface, along the shorter diagonal.
LatticeSurface join_neighbours(const PointLattice& lattice, const LatticeLimits& limits,
                               std::pmr::memory_resource* memory);

// Counter-clockwise seen from the camera, and no steeper than the angle of incidence with this cosine.
bool facing(const Vec3f& a, const Vec3f& b, const Vec3f& c, float min_cosine);
inline float cosine_of_slope(float slope) { return 1 / std::sqrt(1 + slope * slope); }

// The better way to cut the cell at index `k` whole, or 0 where either leaves a triangle steeper than
// `max_slope` or turned away.
std::uint8_t best_cut(const PointLattice& lattice, std::size_t k, float max_slope);

// Whether any triangle holds the node (column, row).
bool carries_surface(const PointLattice& lattice, const LatticeSurface& surface, int column, int row);

}  // namespace relievo::pipeline

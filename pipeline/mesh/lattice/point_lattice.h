// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PointLattice: measured points laid back on the pixel lattice of a rectified view, so that neighbours are found by
// counting. Columns run right, rows down. Frame: the axes of the left camera, the origin where the view's camera
// stands, millimetres.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "pipeline/model/point_cloud.h"

namespace relievo::pipeline {

enum class Node : std::uint8_t { Empty, Measured, Filled };

struct PointLattice {
  explicit PointLattice(std::pmr::memory_resource* memory) : at_mm(memory), sigma_mm(memory), node(memory) {}
  PointLattice(const PointLattice& other, std::pmr::memory_resource* memory)
      : columns(other.columns), rows(other.rows), view(other.view), first_px(other.first_px), step_px(other.step_px), cell_width_mm(other.cell_width_mm), cell_height_mm(other.cell_height_mm),
        at_mm(other.at_mm, memory), sigma_mm(other.sigma_mm, memory), node(other.node, memory) {}
  int columns = 0;
  int rows = 0;
  MiddleView view;     // whose lattice it is, where that is known: then every node lies on its own line of sight
  Vec2f first_px;      // where node (0, 0) stands in its view, and how far its neighbours
  float step_px = 1;
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
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  // Along the view's axis, of a node that has a place.
  double depth_mm(std::size_t k) const {
    const double* axis = &view.rectified_from_left.m[6];
    return axis[0] * static_cast<double>(at_mm[k].x) + axis[1] * static_cast<double>(at_mm[k].y) + axis[2] * static_cast<double>(at_mm[k].z);
  }
  // Where a node stands at that depth.
  Vec3f on_sight(std::size_t k, double depth_mm) const {
    const auto w = static_cast<std::size_t>(columns);
    const double x = static_cast<double>(first_px.x + step_px * static_cast<float>(k % w)), y = static_cast<double>(first_px.y + step_px * static_cast<float>(k / w));
    const Vec3d p = apply(transposed(view.rectified_from_left),
                          Vec3d{(x - view.centre_px.x) / view.focal_px * depth_mm, (y - view.centre_px.y) / view.focal_px * depth_mm, depth_mm});
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  }
  bool inside(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns && row < rows;
  }
};

// Sets the size of a cell by the nodes there are.
void measure_cells(PointLattice& lattice);

// Points that are not finite are left out; where two fall on one node the more certain one stays. An empty lattice where no point is usable.
// Throws std::bad_alloc when `memory` is used up.
PointLattice make_lattice(const PointCloud& cloud, std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline

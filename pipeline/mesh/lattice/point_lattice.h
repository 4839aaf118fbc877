// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PointLattice: measured points laid back on the pixel lattice of the left rectified view, so that
// neighbours are found by counting. Columns run right, rows down. Frame: left camera, millimetres.
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
      : columns(other.columns), rows(other.rows), cell_width_mm(other.cell_width_mm), cell_height_mm(other.cell_height_mm),
        at_mm(other.at_mm, memory), sigma_mm(other.sigma_mm, memory), node(other.node, memory) {}
  int columns = 0;
  int rows = 0;
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
  bool inside(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns && row < rows;
  }
};

// Points that are not finite are left out; where two fall on one node the more certain one stays. An empty lattice where no point is usable.
// Throws std::bad_alloc when `memory` is used up.
PointLattice make_lattice(const PointCloud& cloud, std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline

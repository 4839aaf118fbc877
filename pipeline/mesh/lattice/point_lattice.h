// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PointLattice: measured points laid back on the pixel lattice of a rectified view, so that neighbours are
// found by counting, or laid on a head's chart. Columns run right, rows down, as the camera at the origin
// sees it: the left one, or on a chart one within the head. Axes: the left camera's. Millimetres.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

#include "pipeline/mesh/lattice/head_chart.h"
#include "pipeline/model/point_cloud.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {

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
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  double radius_mm(std::size_t k) const { return static_cast<double>(length(at_mm[k])); }
  // Where a chart's node stands at that distance from its centre.
  Vec3f on_ray(std::size_t k, double radius_mm) const {
    const auto w = static_cast<std::size_t>(columns);
    return chart->at({first_mm.x + step_mm * static_cast<double>(k % w),
                      first_mm.y + step_mm * static_cast<double>(k / w)},
                     radius_mm);
  }
  bool inside(int column, int row) const { return column >= 0 && row >= 0 && column < columns && row < rows; }
};

// Sets the size of a cell by the nodes there are.
void measure_cells(PointLattice& lattice);

// Points that are not finite are left out; where two fall on one node the more certain one stays. An empty
// lattice where no point is usable. Throws std::bad_alloc when `memory` is used up.
PointLattice make_lattice(const PointCloud& cloud, std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline

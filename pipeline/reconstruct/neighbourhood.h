// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Neighbourhood: who is near whom in the left view, for clouds on a lattice and for scattered ones.
// Every cell holds the points of one lattice node (at most one), or of one bucket (a few).
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>

#include "pipeline/base/cells.h"
#include "pipeline/model/point_cloud.h"

namespace relievo::pipeline {

class Neighbourhood {
 public:
  // Throws std::bad_alloc. Points whose coordinates are not finite get no cell.
  Neighbourhood(const PointCloud& cloud, std::pmr::memory_resource* memory);

  bool on_lattice() const { return on_lattice_; }
  int columns() const { return cells_.columns(); }
  int rows() const { return cells_.rows(); }
  // How far around a point its neighbours are looked for, in cells.
  int reach() const { return on_lattice_ ? 2 : 1; }
  std::span<const std::uint32_t> cell(int column, int row) const { return cells_.at(column, row); }

 private:
  bool on_lattice_;
  Cells cells_;
};

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Neighbourhood: who is near whom in the left view, for clouds on a lattice and for scattered ones.
// Every cell holds the points of one lattice node (at most one), or of one bucket (a few).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/model/point_cloud.h"

namespace relievo::pipeline {

class Neighbourhood {
 public:
  // Throws std::bad_alloc. Points whose coordinates are not finite get no cell.
  Neighbourhood(const PointCloud& cloud, std::pmr::memory_resource* memory);

  bool on_lattice() const { return on_lattice_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  // How far around a point its neighbours are looked for, in cells.
  int reach() const { return on_lattice_ ? 2 : 1; }
  std::span<const std::uint32_t> cell(int column, int row) const {
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return {};
    const std::size_t k =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
    return {members_.data() + first_[k], first_[k + 1] - first_[k]};
  }

 private:
  bool on_lattice_;
  int columns_ = 0;
  int rows_ = 0;
  std::pmr::vector<std::uint32_t> first_, members_;
};

}  // namespace relievo::pipeline

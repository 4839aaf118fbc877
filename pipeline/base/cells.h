// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cells: the spatial index of this room: what lies in each cell of a grid over a plane. Whoever fills it
// knows how large a cell is. Throws std::bad_alloc. Thread: any, once filled.
#pragma once

#include <algorithm>

#include "hal/base/groups.h"

namespace relievo::pipeline {

class Cells {
 public:
  explicit Cells(std::pmr::memory_resource* memory) : in_(memory) {}

  // `each` is given add(column, row, member), all within, and called twice, as by Groups::sort().
  template <typename Each>
  void fill(int columns, int rows, Each&& each) {
    columns_ = columns;
    rows_ = rows;
    in_.sort(std::size_t(columns) * std::size_t(rows), [&](auto&& add) {
      each([&](int column, int row, std::uint32_t member) { add(cell(column, row), member); });
    });
  }

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  // Nothing outside of the grid.
  std::span<const std::uint32_t> at(int column, int row) const {
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return {};
    return in_[cell(column, row)];
  }

  // The cells around one that may lie outside, ring by ring, until done(ring) before a ring: look(member).
  template <typename Done, typename Look>
  void by_rings(int column, int row, Done&& done, Look&& look) const {
    for (int ring = 0; !done(ring); ++ring)
      for (int y = std::max(row - ring, 0); y <= std::min(row + ring, rows_ - 1); ++y) {
        const int stride = y == row - ring || y == row + ring || ring == 0 ? 1 : 2 * ring;
        for (int x = column - ring; x <= column + ring; x += stride)
          for (const std::uint32_t member : at(x, y)) look(member);
      }
  }

 private:
  std::size_t cell(int column, int row) const {
    return std::size_t(row) * std::size_t(columns_) + std::size_t(column);
  }

  int columns_ = 0, rows_ = 0;
  Groups in_;
};

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CellMask: which cells of a lattice are in, one byte each, 0 or 1, row by row; and MaskShaper, the
// shapes one makes of masks (Serra 1982) with discs that are round in millimetres as the camera sees
// them, whatever the lattice's cells. Distances run from centre to centre; beyond the border nothing
// is in. Thread: any; deterministic. Throws std::bad_alloc when `memory` is used up.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace relievo::pipeline {

using CellMask = std::pmr::vector<std::uint8_t>;

class MaskShaper {
 public:
  MaskShaper(int columns, int rows, float cell_width_mm, float cell_height_mm,
             std::pmr::memory_resource* memory);

  void dilate(CellMask& mask, float radius_mm);
  void erode(CellMask& mask, float radius_mm);
  // Puts in what lies between: dilates, then erodes by `back_mm`; what was in stays in.
  void close(CellMask& mask, float radius_mm, float back_mm);
  void open(CellMask& mask, float radius_mm);
  // Keeps, or puts in, where at least this share of what lies around (a Gaussian) is in: waves of the
  // border shorter than about four sigmas go. At a half as much is given as taken.
  void straighten(CellMask& mask, float sigma_mm, float share);

  // Puts in whatever is out and cannot be reached from the border, corners included.
  void fill_holes(CellMask& mask);
  // Takes out every piece (joined through sides) of fewer than `least` cells, or all but the largest.
  void drop_pieces_below(CellMask& mask, std::size_t least);
  void keep_largest_piece(CellMask& mask);

 private:
  void mark_within(const CellMask& mask, std::uint8_t wanted, bool beyond_border, float radius_mm,
                   CellMask& out);
  void measure_rows(const CellMask& mask, std::uint8_t wanted, bool beyond_border);
  template <bool Corners>
  void flood(CellMask& mask, std::uint32_t seed, std::uint8_t from, std::uint8_t to);

  int columns_, rows_;
  float cell_width_mm_, cell_height_mm_;
  std::pmr::vector<float> along_row_;      // squared distance to the nearest wanted cell of the row, mm2
  std::pmr::vector<float> nearest_;        // of one row: the same, of all rows
  std::pmr::vector<std::uint32_t> piece_;  // cells of the flood at hand
  CellMask before_;
};

}  // namespace relievo::pipeline

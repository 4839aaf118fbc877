// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Crossings that belong to one chessboard, in the rows and columns in which they lie, whichever way up
// the board is held. Rows run to the right of columns as x does of y: never mirrored.
// Inside calibrate/board/ only. Thread: any.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/calibrate/board/corner_refiner.h"
#include "pipeline/calibrate/board/saddle_finder.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

class Lattice {
 public:
  Lattice(int columns, int rows, bool first_dark)
      : columns_(columns),
        rows_(rows),
        first_dark_(first_dark),
        nodes_(std::size_t(columns) * std::size_t(rows)) {}

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  bool holds(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns_ && row < rows_;
  }
  std::size_t index(int column, int row) const {
    return std::size_t(row) * std::size_t(columns_) + std::size_t(column);
  }
  CornerFit& node(int column, int row) { return nodes_[index(column, row)]; }
  const CornerFit& node(int column, int row) const { return nodes_[index(column, row)]; }
  bool seen(int column, int row) const { return holds(column, row) && node(column, row).seen(); }
  // Of the square between node (column, row) and the next of the row and of the column.
  bool dark(int column, int row) const { return ((column + row) % 2 == 0) == first_dark_; }
  int count() const { return int(std::ranges::count_if(nodes_, &CornerFit::seen)); }
  int count_row(int row) const;
  int count_column(int column) const;

  // columns x rows of it, from (left, top) on; what lies outside is unseen.
  Lattice cut(int left, int top, int columns, int rows) const;
  Lattice quarter_turned() const;  // what was the first column, upwards, is the first row
  void scale(double factor);       // of the places

 private:
  int columns_;
  int rows_;
  bool first_dark_;
  std::vector<CornerFit> nodes_;
};

// Every chessboard-like group of at least `least` crossings, the largest first.
std::vector<Lattice> find_lattices(const SmoothPicture& picture, std::span<const Saddle> saddles, int least);

// Where a node must be and how its edges run, from the nodes around it (not itself), by a local
// homography. No value where too few are seen.
std::optional<CornerGuess> predict(const Lattice& lattice, int column, int row);

// Which part of a ChArUco board a lattice is: the markers in its white squares are read, each votes for
// where the lattice lies on the board, and the place that most agree on wins.

// The first `count` markers of OpenCV's dictionary of `bits` a side: a bit for each module without the
// border, row by row from the lowest; set: white.
std::vector<std::uint64_t> marker_modules(int bits, int count);

// The lattice's nodes in their places on the board: columns x rows of the pattern. No value where too
// few markers agree. The lattice in pixels of the picture.
std::optional<Lattice> place_on_board(const ImageView& picture, const Lattice& lattice,
                                      const BoardPattern& pattern, const std::vector<std::uint64_t>& markers);

}  // namespace relievo::pipeline

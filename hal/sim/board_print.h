// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is printed on a simulated board: chessboard or ChArUco, in the layout that OpenCV 4.6 draws
// (top left square black, marker numbers row by row). Origin in the first inner corner, x along a row
// of corners, y down the rows, mm.
// Thread: any, once made.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/base/result.h"

namespace relievo::hal::sim {

enum class BoardKind : std::uint8_t { Chessboard, Charuco };

struct BoardPattern {
  int corners_x = 10, corners_y = 7;  // inner corners
  double square_mm = 20;
  double margin_mm = 15;  // white, around the outer squares
  BoardKind kind = BoardKind::Chessboard;
  double marker_mm = 0;        // ChArUco: side of a marker; 0: seven tenths of a square
  int marker_bits = 4;         // ChArUco: a side, 4 to 7
  Result<void> check() const;  // InvalidInput
  double marker_side_mm() const { return marker_mm > 0 ? marker_mm : 0.7 * square_mm; }
};

class BoardPrint {
 public:
  explicit BoardPrint(const BoardPattern& pattern);  // the pattern has been checked

  struct Spot {
    bool dark = false;
    std::int64_t cell = 0;  // two spots in one cell have one colour, and so has all between them
  };
  Spot at(double x_mm, double y_mm) const;

 private:
  BoardPattern pattern_;
  int modules_ = 0;                     // of a marker a side, with its border
  std::vector<std::uint64_t> markers_;  // white modules, as marker_modules() gives them
};

// OpenCV's predefined dictionary of `bits` a side: the first `count` markers, a bit for each module
// without the border, row by row from the lowest bit; set: white.
std::vector<std::uint64_t> marker_modules(int bits, int count);

}  // namespace relievo::hal::sim

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Finds the inner corners of a printed chessboard, to a few hundredths of a pixel.
//
// Corners come row by row, `columns` in each row, as the board is seen; which end the order begins
// at is open (a board turned by half looks the same), so pair_order() makes left and right agree.
// Pixels, (0, 0) the centre of the top left pixel.
// Thread: any.
#pragma once

#include <vector>

#include "hal/base/image_view.h"
#include "hal/base/result.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct BoardPattern {
  int columns = 10;  // inner corners, as everywhere in OpenCV
  int rows = 7;
  double square_mm = 20;

  int corners() const { return columns * rows; }
  Result<void> check() const;
};

// All of the pattern. A corner that cannot be trusted is not-a-number and takes no part.
using BoardCorners = std::vector<Vec2d>;

inline bool seen(const Vec2d& corner) { return corner.x == corner.x; }

// Errors: NotFound (no whole board in the picture), InvalidInput (no picture, wrong pattern),
// LibraryFailed.
Result<BoardCorners> find_board(const ImageView& picture, const BoardPattern& pattern);

// Turns `right` by half where its rows run against those of `left`: cameras that stand side by side
// see a board the same way up.
void pair_order(const BoardCorners& left, BoardCorners& right, const BoardPattern& pattern);

}  // namespace relievo::pipeline

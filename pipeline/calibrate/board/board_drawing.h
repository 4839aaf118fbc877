// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is black on a board: for a printer. Origin in the top left corner of the outer squares, x along
// a row, y down, mm; the field measures (columns + 1) x (rows + 1) squares.
// Thread: any.
#pragma once

#include <vector>

#include "hal/base/result.h"
#include "pipeline/calibrate/board/board_finder.h"

namespace relievo::pipeline {

struct BlackArea {
  double x_mm, y_mm, width_mm, height_mm;
};

// Errors: InvalidInput (wrong pattern), LibraryFailed.
Result<std::vector<BlackArea>> draw_board(const BoardPattern& pattern);

}  // namespace relievo::pipeline

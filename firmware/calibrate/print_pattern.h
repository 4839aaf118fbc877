// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// relievo calibrate --print-pattern chessboard|charuco --corners 10x7 --square-mm 20 -o board.pdf
//
// A page at true size: the board in the middle of the smallest ISO paper that holds it with a white
// margin of at least a square, below it a ruler to check the print with, and what it is. PDF or SVG.
// Page coordinates: from the top left, x right, y down, mm.
// Thread: any.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/calibrate/board/board_finder.h"

namespace relievo::firmware {

struct PatternPage {
  const char* paper = "";  // "A4"
  double width_mm = 0, height_mm = 0;
  double board_x_mm = 0, board_y_mm = 0;    // of the outer squares
  double ruler_x_mm = 0, ruler_y_mm = 0;    // left end; the line itself
  double ruler_mm = 0;                      // true length
  double text_x_mm = 0, text_width_mm = 0;  // beside the ruler
  std::vector<std::string> text;
};

// Errors: InvalidInput (wrong pattern, larger than A0).
Result<PatternPage> lay_out_pattern(const pipeline::BoardPattern& pattern);

enum class PageFormat { Pdf, Svg };

// By the ending of the file's name. InvalidInput: another one.
Result<PageFormat> page_format(std::string_view file_name);

// The page as a file's bytes. Errors: the pattern's, LibraryFailed.
Result<std::vector<std::byte>> draw_page(const PatternPage& page, const pipeline::BoardPattern& pattern,
                                         PageFormat format);

}  // namespace relievo::firmware

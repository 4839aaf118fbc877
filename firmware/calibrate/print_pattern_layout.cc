// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>

#include "firmware/calibrate/print_pattern.h"

namespace relievo::firmware {
namespace {

struct Paper {
  const char* name;
  double short_mm, long_mm;
};
constexpr std::array kPapers{Paper{"A4", 210, 297}, Paper{"A3", 297, 420}, Paper{"A2", 420, 594},
                             Paper{"A1", 594, 841}, Paper{"A0", 841, 1189}};

constexpr double kUnprintableMm = 5;  // rim that printers leave white
constexpr double kMinMarginMm = 8;    // white around the board, where squares are small
constexpr double kFooterMm = 10;      // for ruler and words, with the rim below
constexpr double kRulerMm = 100;
constexpr double kGapMm = 5;  // between ruler and words

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::vector<std::string> words_of(const pipeline::BoardPattern& b) {
  const std::string corners = std::to_string(b.columns) + "x" + std::to_string(b.rows);
  const std::string square = number(b.square_mm);
  std::string what = "chessboard";
  std::string how = "--corners " + corners + " --square-mm " + square;
  if (b.kind == pipeline::BoardKind::Charuco) {
    const std::string bits = std::to_string(b.marker_bits);
    what =
        "ChArUco board, markers " + number(b.marker_side_mm()) + " mm of DICT_" + bits + "X" + bits + "_1000";
    how = "--pattern charuco " + how;
    if (b.marker_mm > 0) how += " --marker-mm " + number(b.marker_mm);
    if (b.marker_bits != 4) how += " --marker-bits " + bits;
  }
  return {"Relievo " + what + ", " + corners + " inner corners, squares " + square + " mm: " + how,
          "Print at 100 %, measure this line: " + number(kRulerMm) + " mm. The outer squares measure " +
              number((b.columns + 1) * b.square_mm) + " x " + number((b.rows + 1) * b.square_mm) + " mm."};
}

}  // namespace

Result<PageFormat> page_format(std::string_view file_name) {
  const std::size_t dot = file_name.rfind('.');
  std::string ending(dot == std::string_view::npos ? "" : file_name.substr(dot + 1));
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == "pdf") return PageFormat::Pdf;
  if (ending == "svg") return PageFormat::Svg;
  return Error{Errc::InvalidInput, "the page is a PDF or an SVG: give a name that ends in .pdf or .svg"}.at(
      file_name);
}

Result<PatternPage> lay_out_pattern(const pipeline::BoardPattern& pattern) {
  RELIEVO_TRY(pattern.check());
  const double board_width = (pattern.columns + 1) * pattern.square_mm;
  const double board_height = (pattern.rows + 1) * pattern.square_mm;
  const double margin = std::max(pattern.square_mm, kMinMarginMm);
  const double width = board_width + 2 * margin;
  const double height = board_height + 2 * margin + kFooterMm;
  for (const Paper& paper : kPapers)
    for (const bool upright : {pattern.rows > pattern.columns, pattern.rows <= pattern.columns}) {
      PatternPage page;
      page.paper = paper.name;
      page.width_mm = upright ? paper.short_mm : paper.long_mm;
      page.height_mm = upright ? paper.long_mm : paper.short_mm;
      if (width > page.width_mm || height > page.height_mm) continue;
      page.board_x_mm = (page.width_mm - board_width) / 2;
      page.board_y_mm = margin + (page.height_mm - height) / 2;
      page.ruler_x_mm = 2 * kUnprintableMm;
      page.ruler_y_mm = page.height_mm - kUnprintableMm - 2.4;
      page.ruler_mm = kRulerMm;
      page.text_x_mm = page.ruler_x_mm + kRulerMm + kGapMm;
      page.text_width_mm = page.width_mm - page.text_x_mm - kUnprintableMm;
      page.text = words_of(pattern);
      return page;
    }
  return Error{Errc::InvalidInput,
               "this board with its margin is larger than A0 paper; choose fewer or smaller squares"}
      .at(number(board_width) + " x " + number(board_height) + " mm");
}

}  // namespace relievo::firmware

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/board/board_drawing.h"

#include <cstddef>
#include <exception>

#include "pipeline/calibrate/board/marker_reader.h"

namespace relievo::pipeline {
namespace {

// A marker with its black border, each row of modules in as few pieces as there are runs.
void draw_marker(std::uint64_t white, int bits, double x_mm, double y_mm, double side_mm,
                 std::vector<BlackArea>& out) {
  const int modules = bits + 2;
  const double module_mm = side_mm / modules;
  const auto black = [&](int column, int row) {
    if (column == 0 || row == 0 || column == modules - 1 || row == modules - 1) return true;
    return (white >> ((row - 1) * bits + column - 1) & 1) == 0;
  };
  for (int row = 0; row < modules; ++row)
    for (int column = 0; column < modules;) {
      if (!black(column, row)) {
        ++column;
        continue;
      }
      const int first = column;
      while (column < modules && black(column, row)) ++column;
      out.push_back(
          {x_mm + first * module_mm, y_mm + row * module_mm, (column - first) * module_mm, module_mm});
    }
}

}  // namespace

Result<std::vector<BlackArea>> draw_board(const BoardPattern& pattern) try {
  RELIEVO_TRY(pattern.check());
  const bool charuco = pattern.kind == BoardKind::Charuco;
  const auto markers =
      charuco ? marker_modules(pattern.marker_bits, pattern.markers()) : std::vector<std::uint64_t>();
  const double side = pattern.square_mm;
  const double rim = (side - pattern.marker_side_mm()) / 2;
  std::vector<BlackArea> out;
  std::size_t marker = 0;
  for (int row = 0; row <= pattern.rows; ++row)
    for (int column = 0; column <= pattern.columns; ++column) {
      if ((column + row) % 2 == 0) out.push_back({column * side, row * side, side, side});
      else if (charuco)
        draw_marker(markers[marker++], pattern.marker_bits, column * side + rim, row * side + rim,
                    pattern.marker_side_mm(), out);
    }
  return out;
} catch (const std::exception&) {
  return Error{Errc::LibraryFailed, "OpenCV's dictionary of markers cannot be read"};
}

}  // namespace relievo::pipeline

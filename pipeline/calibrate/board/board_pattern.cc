// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstddef>
#include <exception>
#include <utility>

#include "pipeline/calibrate/board/board_finder.h"

#include "pipeline/calibrate/board/marker_reader.h"

namespace relievo::pipeline {
namespace {

constexpr int kMostMarkers = 1000;  // of a dictionary

std::size_t index(const BoardPattern& pattern, int column, int row) {
  return std::size_t(row) * std::size_t(pattern.columns) + std::size_t(column);
}

BoardCorners half_turned(const BoardCorners& corners) { return {corners.rbegin(), corners.rend()}; }

// Of a board with as many columns as rows.
BoardCorners quarter_turned(const BoardCorners& corners, const BoardPattern& pattern) {
  BoardCorners out;
  for (int row = 0; row < pattern.rows; ++row)
    for (int column = 0; column < pattern.columns; ++column)
      out.push_back(corners[index(pattern, row, pattern.rows - 1 - column)]);
  return out;
}

// The sum of the steps along all rows.
Vec2d run_of(const BoardCorners& corners, const BoardPattern& pattern) {
  Vec2d sum;
  for (int row = 0; row < pattern.rows; ++row)
    for (int column = 0; column + 1 < pattern.columns; ++column) {
      const Vec2d& a = corners[index(pattern, column, row)];
      const Vec2d& b = corners[index(pattern, column + 1, row)];
      if (seen(a) && seen(b)) sum = {sum.x + b.x - a.x, sum.y + b.y - a.y};
    }
  return sum;
}

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

Result<void> BoardPattern::check() const {
  if (columns < 3 || rows < 3 || columns > 60 || rows > 60)
    return Error{Errc::InvalidInput, "a board has 3 to 60 inner corners a side, as in 10x7"}.at("--corners");
  if (!(square_mm >= 0.1 && square_mm <= 1000))
    return Error{Errc::InvalidInput, "a square must measure 0.1 to 1000 mm"}.at("--square-mm");
  if (kind == BoardKind::Chessboard) return {};
  if (!(marker_side_mm() >= 0.3 * square_mm && marker_side_mm() <= 0.9 * square_mm))
    return Error{Errc::InvalidInput, "a marker measures 0.3 to 0.9 of its square"}.at("--marker-mm");
  if (marker_bits < 4 || marker_bits > 7)
    return Error{Errc::InvalidInput, "a marker has 4 to 7 bits a side"}.at("--marker-bits");
  if (markers() > kMostMarkers)
    return Error{Errc::InvalidInput, "a ChArUco board has at most 1000 markers; choose fewer corners"}.at(
        "--corners");
  return {};
}

void pair_order(const BoardCorners& left, BoardCorners& right, const BoardPattern& pattern) {
  if (pattern.kind == BoardKind::Charuco) return;
  const Vec2d a = run_of(left, pattern);
  const auto agreement = [&](const BoardCorners& corners) {
    const Vec2d b = run_of(corners, pattern);
    return a.x * b.x + a.y * b.y;
  };
  const auto offer = [&](BoardCorners turned) {
    if (agreement(turned) > agreement(right)) right = std::move(turned);
  };
  offer(half_turned(right));
  if (pattern.columns != pattern.rows) return;
  offer(quarter_turned(right, pattern));
  offer(half_turned(quarter_turned(right, pattern)));
}

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

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/board_print.h"

#include <algorithm>
#include <cmath>

namespace relievo::hal::sim {
namespace {

constexpr int kMostMarkers = 1000;  // of a dictionary
constexpr std::int64_t kCellsASquare = 128;

int marker_count(const BoardPattern& b) { return (b.corners_x + 1) * (b.corners_y + 1) / 2; }

}  // namespace

Result<void> BoardPattern::check() const {
  if (corners_x < 3 || corners_y < 3 || corners_x > 60 || corners_y > 60)
    return Error{Errc::InvalidInput, "a board has between 3 and 60 inner corners a side"};
  if (!(square_mm >= 1) || !(square_mm <= 500))
    return Error{Errc::InvalidInput, "the squares of a board measure between 1 and 500 mm"};
  if (kind == BoardKind::Chessboard) return {};
  if (!(marker_side_mm() >= 0.3 * square_mm) || !(marker_side_mm() <= 0.9 * square_mm))
    return Error{Errc::InvalidInput, "a marker measures between 0.3 and 0.9 of its square"};
  if (marker_bits < 4 || marker_bits > 7)
    return Error{Errc::InvalidInput, "a marker has between 4 and 7 bits a side"};
  if (marker_count(*this) > kMostMarkers)
    return Error{Errc::InvalidInput, "a ChArUco board has at most 1000 markers; choose fewer corners"};
  return {};
}

BoardPrint::BoardPrint(const BoardPattern& pattern) : pattern_(pattern) {
  if (pattern.kind == BoardKind::Chessboard) return;
  modules_ = pattern.marker_bits + 2;
  markers_ = marker_modules(pattern.marker_bits, marker_count(pattern));
}

BoardPrint::Spot BoardPrint::at(double x_mm, double y_mm) const {
  const double sx = x_mm / pattern_.square_mm + 1,
               sy = y_mm / pattern_.square_mm + 1;  // from the top left of the print
  const int across = pattern_.corners_x + 1, down = pattern_.corners_y + 1;
  if (!(sx >= 0 && sy >= 0 && sx < across && sy < down)) return {false, -1};
  const int column = static_cast<int>(sx), row = static_cast<int>(sy);
  const std::int64_t cell = (static_cast<std::int64_t>(row) * across + column) * kCellsASquare;
  if ((column + row) % 2 == 0) return {true, cell};
  if (pattern_.kind == BoardKind::Chessboard) return {false, cell};
  const double side = pattern_.marker_side_mm() / pattern_.square_mm / modules_;
  const double low = 0.5 - 0.5 * modules_ * side;
  const int u = std::clamp(static_cast<int>(std::floor((sx - column - low) / side)), -1, modules_);
  const int v = std::clamp(static_cast<int>(std::floor((sy - row - low) / side)), -1, modules_);
  const auto spot = [&](bool dark) { return Spot{dark, cell + (v + 1) * (modules_ + 2) + u + 1}; };
  if (u < 0 || v < 0 || u == modules_ || v == modules_) return spot(false);
  if (u == 0 || v == 0 || u == modules_ - 1 || v == modules_ - 1) return spot(true);
  // Numbers run over the white squares, row by row.
  const int id = (row * across + column) / 2, bit = (v - 1) * (modules_ - 2) + u - 1;
  return spot((markers_[static_cast<std::size_t>(id)] >> bit & 1) == 0);
}

}  // namespace relievo::hal::sim

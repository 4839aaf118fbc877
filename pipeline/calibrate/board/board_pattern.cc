// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "pipeline/calibrate/board/board_finder.h"

namespace relievo::pipeline {

Result<void> BoardPattern::check() const {
  if (columns < 3 || rows < 3 || columns > 60 || rows > 60)
    return Error{Errc::InvalidInput, "a board has 3 to 60 inner corners a side, as in 10x7"}.at("--corners");
  if (columns == rows)
    return Error{Errc::InvalidInput,
                 "a board with as many columns as rows has no way up; use one such as 10x7"}
        .at("--corners");
  if (!(square_mm >= 0.1 && square_mm <= 1000))
    return Error{Errc::InvalidInput, "a square must measure 0.1 to 1000 mm"}.at("--square-mm");
  return {};
}

void pair_order(const BoardCorners& left, BoardCorners& right, const BoardPattern& pattern) {
  const auto along_row = [&pattern](const BoardCorners& corners) {
    Vec2d sum;
    for (int r = 0; r < pattern.rows; ++r) {
      const Vec2d& first = corners[static_cast<std::size_t>(r * pattern.columns)];
      const Vec2d& last = corners[static_cast<std::size_t>((r + 1) * pattern.columns - 1)];
      if (seen(first) && seen(last)) sum = {sum.x + last.x - first.x, sum.y + last.y - first.y};
    }
    return sum;
  };
  const Vec2d a = along_row(left);
  const Vec2d b = along_row(right);
  if (a.x * b.x + a.y * b.y < 0) std::reverse(right.begin(), right.end());
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sums over a square window that slides over a plane: each texel enters and leaves once.
#pragma once

#include <algorithm>
#include <span>

#include "pipeline/texture/chart/raster.h"

namespace relievo::pipeline {

struct BoxSum {
  int first = 0, second = 0;
};

// emit(x, y, sum) for every texel of `rows`; the window reaches `radius` texels each way and is cut at
// the plane's borders. value(x, y) gives what is summed. `columns`: one a column, for this call alone.
template <typename Value, typename Emit>
void slide_box(int width, int height, int radius, RowRange rows, std::span<BoxSum> columns, Value&& value,
               Emit&& emit) {
  std::fill(columns.begin(), columns.end(), BoxSum{});
  const auto add_row = [&](int y, int sign) {
    if (y < 0 || y >= height) return;
    for (int x = 0; x < width; ++x) {
      const BoxSum v = value(x, y);
      columns[static_cast<std::size_t>(x)].first += sign * v.first;
      columns[static_cast<std::size_t>(x)].second += sign * v.second;
    }
  };
  for (int y = rows.begin - radius; y < rows.begin + radius; ++y) add_row(y, 1);
  for (int y = rows.begin; y < rows.end; ++y) {
    add_row(y + radius, 1);
    BoxSum sum;
    const auto add_column = [&](int x, int sign) {
      if (x < 0 || x >= width) return;
      sum.first += sign * columns[static_cast<std::size_t>(x)].first;
      sum.second += sign * columns[static_cast<std::size_t>(x)].second;
    };
    for (int x = 0; x < radius; ++x) add_column(x, 1);
    for (int x = 0; x < width; ++x) {
      add_column(x + radius, 1);
      emit(x, y, sum);
      add_column(x - radius, -1);
    }
    add_row(y - radius, -1);
  }
}

}  // namespace relievo::pipeline

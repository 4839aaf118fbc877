// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/coarse/two_way.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace relievo::pipeline {

Result<void> match_both(const PyramidLevel& left, const PyramidLevel& right, int candidates, const SemiGlobalCosts& costs,
                        StageContext& context, TwoWay& both) {
  const int w = left.grey.width;
  const int h = left.grey.height;
  Plane<std::uint64_t> census_left(&context.scratch, w, h);
  Plane<std::uint64_t> census_right(&context.scratch, w, h);
  context.pool.for_each_band(h, 8, [&](int begin, int end, int) {
    census_rows(left.grey, census_left, begin, end);
    census_rows(right.grey, census_right, begin, end);
  });
  // One arena for two threads: each gets a block of its own, taken here.
  const auto cells = static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * static_cast<std::size_t>(candidates);
  const std::size_t share = 3 * cells + 64 * static_cast<std::size_t>(w) * (static_cast<std::size_t>(candidates) + 4) + 65536;
  std::pmr::vector<std::byte> blocks(2 * share, &context.scratch);
  context.pool.for_each_band(2, 2, [&](int begin, int end, int) {
    for (int side = begin; side < end; ++side) {
      Arena own{std::span<std::byte>(blocks).subspan(static_cast<std::size_t>(side) * share, share)};
      if (side == 0)
        semi_global({census_left, census_right, left.valid, right.valid, +1}, both.first_left, candidates, costs, own, both.left, &context.cancelled);
      else
        semi_global({census_right, census_left, right.valid, left.valid, -1}, both.first_right, candidates, costs, own, both.right, &context.cancelled);
    }
  });
  if (context.stop()) return Error{Errc::Cancelled, "stopped while matching coarsely"};
  return {};
}

void predict(const Plane<float>& coarse, int band, int whole_first, int whole_last, Plane<std::int16_t>& first) {
  for (int y = 0; y < first.height; ++y) {
    const float* from = coarse.row(std::min(y / 2, coarse.height - 1));
    float last = kNoDisparity;
    for (int x = 0; x < coarse.width && last == kNoDisparity; ++x) last = from[x];
    if (last == kNoDisparity) last = 0.25F * static_cast<float>(whole_first + whole_last);
    for (int x = 0; x < first.width; ++x) {
      const float d = from[std::min(x / 2, coarse.width - 1)];
      if (d != kNoDisparity) last = d;
      const int start = static_cast<int>(std::lround(2 * last)) - band / 2;
      first.row(y)[x] = static_cast<std::int16_t>(std::clamp(start, whole_first, std::max(whole_first, whole_last - band)));
    }
  }
}

void median3(Plane<float>& field, std::pmr::memory_resource& scratch) {
  Plane<float> copy(&scratch, field.width, field.height);
  copy.values = field.values;
  for (int y = 1; y < field.height - 1; ++y)
    for (int x = 1; x < field.width - 1; ++x) {
      float near[9];
      int n = 0;
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
          if (copy.row(y + j)[x + i] != kNoDisparity) near[n++] = copy.row(y + j)[x + i];
      if (n == 0 || (copy.row(y)[x] == kNoDisparity && n < 5)) continue;
      std::nth_element(near, near + n / 2, near + n);
      field.row(y)[x] = near[n / 2];
    }
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/coarse/size_ladder.h"

#include <algorithm>
#include <cmath>

#include "pipeline/match/coarse/two_way.h"

namespace relievo::pipeline {

DisparityRange whole_range(const RectifiedPair& pair) {
  return {pair.disparity_px(pair.far_mm), pair.disparity_px(pair.near_mm)};
}

Result<void> match_down(const DisparityRange& range, const Pyramids& pyramids, const SizeLadder& ladder,
                        const SemiGlobalCosts& costs, StageContext& context, float progress_share,
                        Plane<float>& finest) {
  Arena::Mark all(context.scratch);
  const double scale = 1 << ladder.coarsest;
  int first = static_cast<int>(std::floor(range.least_px / scale)) - 1;
  int last = static_cast<int>(std::ceil(range.most_px / scale)) + 1;
  Plane<float> left(&context.scratch, 0, 0);
  Plane<float> right(&context.scratch, 0, 0);
  for (int level = ladder.coarsest; level >= ladder.finest; --level) {
    const PyramidLevel& from = pyramids.left[static_cast<std::size_t>(level)];
    const PyramidLevel& to = pyramids.right[static_cast<std::size_t>(level)];
    Plane<float> next_left(&context.scratch, from.grey.width, from.grey.height);
    Plane<float> next_right(&context.scratch, from.grey.width, from.grey.height);
    Arena::Mark mark(context.scratch);
    TwoWay both(&context.scratch, from.grey.width, from.grey.height);
    int candidates = last - first + 1;
    if (level == ladder.coarsest) {
      std::fill(both.first_left.values.begin(), both.first_left.values.end(),
                static_cast<std::int16_t>(first));
      std::fill(both.first_right.values.begin(), both.first_right.values.end(),
                static_cast<std::int16_t>(first));
    } else {
      candidates = ladder.band;
      predict(left, ladder.band, first, last, both.first_left);
      predict(right, ladder.band, first, last, both.first_right);
    }
    RELIEVO_TRY(match_both(from, to, candidates, costs, context, both));
    cross_check(both.left, both.right, ladder.cross_check_px);
    median3(both.left, context);
    std::copy(both.left.values.begin(), both.left.values.end(), next_left.values.begin());
    if (level > ladder.finest) {  // of the finest size only the left view's is asked for
      median3(both.right, context);
      std::copy(both.right.values.begin(), both.right.values.end(), next_right.values.begin());
    }
    left = std::move(next_left);
    right = std::move(next_right);
    first *= 2;
    last *= 2;
    context.progress.done.store(progress_share * static_cast<float>(ladder.coarsest + 1 - level) /
                                    static_cast<float>(ladder.coarsest + 1 - ladder.finest),
                                std::memory_order_relaxed);
  }
  std::copy(left.values.begin(), left.values.end(), finest.values.begin());
  return {};
}

}  // namespace relievo::pipeline

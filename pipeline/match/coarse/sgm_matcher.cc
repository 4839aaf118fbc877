// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/coarse/sgm_matcher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/simd.h"
#include "pipeline/base/stage.h"
#include "pipeline/match/image/plane_filters.h"
#include "pipeline/match/window/window_correlation.h"

namespace relievo::pipeline {
namespace {

// Both views of one size, matched against each other.
struct TwoWay {
  PlaneShape shape;
  Plane<float> left{shape, kNoDisparity}, right{shape, kNoDisparity};  // disparities of either view's pixels
  Plane<std::int16_t> first_left{shape}, first_right{shape};  // the band's first candidate at every pixel
};

// Memory: scratch; 2 * width * height * candidates * 3 bytes. Errors: Cancelled.
Result<void> match_both(const PyramidLevel& left, const PyramidLevel& right, int candidates,
                        const SemiGlobalCosts& costs, StageContext& context, TwoWay& both) {
  const int w = left.grey.width;
  const int h = left.grey.height;
  Plane<std::uint64_t> census_left(&context.scratch, w, h);
  Plane<std::uint64_t> census_right(&context.scratch, w, h);
  context.pool.for_each(h, 8, [&](int y) {
    census_row(left.grey, census_left, y);
    census_row(right.grey, census_right, y);
  });
  // One arena for two threads: each gets a block of its own, taken here.
  const auto cells = std::size_t(w) * std::size_t(h) * std::size_t(candidates);
  const std::size_t share = 3 * cells + 64 * std::size_t(w) * (std::size_t(candidates) + 16) + 65536;
  const std::span<std::byte> blocks(
      static_cast<std::byte*>(context.scratch.allocate(2 * share, alignof(std::max_align_t))), 2 * share);
  context.pool.for_each(2, 2, [&](int side) {
    Arena own{blocks.subspan(std::size_t(side) * share, share)};
    if (side == 0)
      semi_global({census_left, census_right, left.valid, right.valid, +1}, both.first_left, candidates,
                  costs, own, both.left, &context.cancelled);
    else
      semi_global({census_right, census_left, right.valid, left.valid, -1}, both.first_right, candidates,
                  costs, own, both.right, &context.cancelled);
  });
  if (context.stop()) return stopped();
  return {};
}

// Bands for the finer size: every pixel takes its coarse parent's disparity; where that is unknown, the
// last one known on the row stands in. Between whole_first and whole_last, disparities of the finer size.
void predict(const Plane<float>& coarse, int band, int whole_first, int whole_last,
             Plane<std::int16_t>& first) {
  for (int y = 0; y < first.height; ++y) {
    const float* from = coarse.row(std::min(y / 2, coarse.height - 1));
    float last = kNoDisparity;
    for (int x = 0; x < coarse.width && last == kNoDisparity; ++x) last = from[x];
    if (last == kNoDisparity) last = 0.25F * float(whole_first + whole_last);
    for (int x = 0; x < first.width; ++x) {
      const float d = from[std::min(x / 2, coarse.width - 1)];
      if (d != kNoDisparity) last = d;
      const int start = int(std::lround(2 * last)) - band / 2;
      first.row(y)[x] =
          std::int16_t(std::clamp(start, whole_first, std::max(whole_first, whole_last - band)));
    }
  }
}

inline void order(float& a, float& b) {
  const float least = std::min(a, b);
  b = std::max(a, b);
  a = least;
}

// The median of nine by nineteen exchanges (Paeth, Median finding on a 3x3 grid, Graphics Gems, 1990).
inline float median_of_nine(float* v) {
  order(v[1], v[2]), order(v[4], v[5]), order(v[7], v[8]);
  order(v[0], v[1]), order(v[3], v[4]), order(v[6], v[7]);
  order(v[1], v[2]), order(v[4], v[5]), order(v[7], v[8]);
  order(v[0], v[3]), order(v[5], v[8]), order(v[4], v[7]);
  order(v[3], v[6]), order(v[1], v[4]), order(v[2], v[5]);
  order(v[4], v[7]), order(v[4], v[2]), order(v[6], v[4]);
  order(v[4], v[2]);
  return v[4];
}

// Nine in order by twenty-five exchanges (Dobbelaere's list of sorting networks); the least known one of
// `known` stands behind the unknown ones.
inline float median_of_known(float* v, int known) {
  constexpr std::array<std::array<std::int8_t, 2>, 25> kExchanges{
      {{0, 3}, {1, 7}, {2, 5}, {4, 8}, {0, 7}, {2, 4}, {3, 8}, {5, 6}, {0, 2}, {1, 3}, {4, 5}, {7, 8}, {1, 4},
       {3, 6}, {5, 7}, {0, 1}, {2, 4}, {3, 5}, {6, 8}, {2, 3}, {4, 5}, {6, 7}, {1, 2}, {3, 4}, {5, 6}}};
#pragma GCC unroll 25
  for (const auto& [a, b] : kExchanges) order(v[a], v[b]);
  return v[9 - known + known / 2];
}

// As if all nine were known, as they are nearly everywhere, without a branch; the least and the most of the
// nine tell whether they are.
RELIEVO_SIMD void medians_of_nine(const float* above, const float* row, const float* below, int width,
                                  float* median, float* least, float* most) {
  for (int x = 1; x < width - 1; ++x) {
    float v[9] = {above[x - 1], above[x],     above[x + 1], row[x - 1],  row[x],
                  row[x + 1],   below[x - 1], below[x],     below[x + 1]};
    float low = v[0], high = v[0];
    for (int i = 1; i < 9; ++i) low = std::min(low, v[i]), high = std::max(high, v[i]);
    least[x] = low;
    most[x] = high;
    median[x] = median_of_nine(v);
  }
}

// `least`, `most`: a row of room each.
void median_row(const Plane<float>& from, int y, float* least, float* most, float* to) {
  medians_of_nine(from.row(y - 1), from.row(y), from.row(y + 1), from.width, to, least, most);
  for (int x = 1; x < from.width - 1; ++x) {
    if (least[x] != kNoDisparity) continue;
    to[x] = from.row(y)[x];
    if (most[x] == kNoDisparity) continue;
    float near[9];
    int known = 0;
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        const float v = from.row(y + j)[x + i];
        near[3 * (j + 1) + i + 1] = v;
        known += v != kNoDisparity ? 1 : 0;
      }
    if (to[x] == kNoDisparity && known < 5) continue;
    to[x] = median_of_known(near, known);
  }
}

// A 3 x 3 median over what is known; closes single holes.
void median3(Plane<float>& field, StageContext& context) {
  Arena::Mark mark(context.scratch);
  Plane<float> copy(&context.scratch, field.width, field.height);
  copy.values = field.values;
  constexpr int kMedianBands = 16;
  Plane<float> least(&context.scratch, field.width, kMedianBands),
      most(&context.scratch, field.width, kMedianBands);
  context.pool.for_each(field.height, kMedianBands, [&](int y, int band) {
    if (y > 0 && y < field.height - 1) median_row(copy, y, least.row(band), most.row(band), field.row(y));
  });
}

}  // namespace

DisparityInterval whole_range(const RectifiedPair& pair) {
  return {pair.disparity_px(pair.far_mm), pair.disparity_px(pair.near_mm)};
}

Result<void> match_down(const DisparityInterval& range, const Pyramids& pyramids, const SizeLadder& ladder,
                        const SemiGlobalCosts& costs, StageContext& context, float progress_share,
                        Plane<float>& finest) {
  Arena::Mark all(context.scratch);
  const double scale = 1 << ladder.coarsest;
  int first = int(std::floor(range.least_px / scale)) - 1;
  int last = int(std::ceil(range.most_px / scale)) + 1;
  Plane<float> left(&context.scratch, 0, 0);
  Plane<float> right(&context.scratch, 0, 0);
  for (int level = ladder.coarsest; level >= ladder.finest; --level) {
    const PyramidLevel& from = pyramids.left[std::size_t(level)];
    const PyramidLevel& to = pyramids.right[std::size_t(level)];
    Plane<float> next_left(&context.scratch, from.grey.width, from.grey.height);
    Plane<float> next_right(&context.scratch, from.grey.width, from.grey.height);
    Arena::Mark mark(context.scratch);
    TwoWay both{{&context.scratch, from.grey.width, from.grey.height}};
    int candidates = last - first + 1;
    if (level == ladder.coarsest) {
      std::ranges::fill(both.first_left.values, std::int16_t(first));
      std::ranges::fill(both.first_right.values, std::int16_t(first));
    } else {
      candidates = ladder.band;
      predict(left, ladder.band, first, last, both.first_left);
      predict(right, ladder.band, first, last, both.first_right);
    }
    RELIEVO_TRY(match_both(from, to, candidates, costs, context, both));
    // What the other view does not confirm is not known.
    for (int y = 0; y < both.left.height; ++y) {
      float* l = both.left.row(y);
      const float* r = both.right.row(y);
      for (int x = 0; x < both.left.width; ++x) {
        if (l[x] == kNoDisparity) continue;
        const int other = int(std::lround(float(x) - l[x]));
        if (other < 0 || other >= both.right.width || !(std::abs(r[other] - l[x]) <= ladder.cross_check_px))
          l[x] = kNoDisparity;
      }
    }
    median3(both.left, context);
    std::ranges::copy(both.left.values, next_left.values.begin());
    if (level > ladder.finest) {  // of the finest size only the left view's is asked for
      median3(both.right, context);
      std::ranges::copy(both.right.values, next_right.values.begin());
    }
    left = std::move(next_left);
    right = std::move(next_right);
    first *= 2;
    last *= 2;
    context.progress.done.store(
        progress_share * float(ladder.coarsest + 1 - level) / float(ladder.coarsest + 1 - ladder.finest),
        std::memory_order_relaxed);
  }
  std::ranges::copy(left.values, finest.values.begin());
  return {};
}

Result<void> SgmMatcher::check() const {
  if (coarsest < finest) return invalid("coarsest must be at least finest").at("sgm");
  return {};
}

Result<MatchSet> SgmMatcher::match(const RectifiedPair& pair, const Keypoints& keypoints,
                                   StageContext& context) const {
  if (pair.width_px < 64 || pair.height_px < 64 || pair.left.grey.empty() || pair.right.grey.empty())
    return invalid("the rectified pair is smaller than 64 pixels");
  const int scale = 1 << finest;
  DisparityField field{
      {&context.scratch, (pair.width_px + scale - 1) / scale, (pair.height_px + scale - 1) / scale},
      {},
      float(scale)};
  {
    Arena::Mark mark(context.scratch);
    const Pyramids pyramids = build_pyramids(pair, coarsest + 1, context);
    const SizeLadder ladder{coarsest, finest, band, cross_check_px};
    RELIEVO_TRY(match_down(whole_range(pair), pyramids, ladder, costs, context, 0.8F, field.values));
  }
  return matches_in_field(field, pair, keypoints, context);
}

}  // namespace relievo::pipeline

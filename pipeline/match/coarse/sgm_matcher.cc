// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/coarse/sgm_matcher.h"

#include <algorithm>
#include <cmath>

#include "pipeline/match/coarse/two_way.h"
#include "pipeline/match/image/field_reader.h"
#include "pipeline/match/image/pyramids.h"
#include "pipeline/match/window/window_correlation.h"

namespace relievo::pipeline {
namespace {

constexpr int kCoarsest = 3;
constexpr int kCorrelationRadius = 4;
constexpr float kFitPx = 1.0F / 6;     // of the equiangular fit, pixels of the finest size
constexpr int kBands = 32;

// The field of the left view at the finest size, from the whole volume down.
Result<void> match_sizes(const RectifiedPair& pair, const SgmMatcherOptions& options, StageContext& context, Plane<float>& finest) {
  const Pyramids pyramids = build_pyramids(pair, kCoarsest + 1, context);
  const double scale = 1 << kCoarsest;
  int first = static_cast<int>(std::floor(pair.disparity_px(pair.far_mm) / scale)) - 1;
  int last = static_cast<int>(std::ceil(pair.disparity_px(pair.near_mm) / scale)) + 1;
  Plane<float> left(&context.scratch, 0, 0);
  Plane<float> right(&context.scratch, 0, 0);
  for (int level = kCoarsest; level >= options.finest; --level) {
    const PyramidLevel& from = pyramids.left[static_cast<std::size_t>(level)];
    const PyramidLevel& to = pyramids.right[static_cast<std::size_t>(level)];
    Plane<float> next_left(&context.scratch, from.grey.width, from.grey.height);
    Plane<float> next_right(&context.scratch, from.grey.width, from.grey.height);
    Arena::Mark mark(context.scratch);
    TwoWay both(&context.scratch, from.grey.width, from.grey.height);
    int candidates = last - first + 1;
    if (level == kCoarsest) {
      std::fill(both.first_left.values.begin(), both.first_left.values.end(), static_cast<std::int16_t>(first));
      std::fill(both.first_right.values.begin(), both.first_right.values.end(), static_cast<std::int16_t>(first));
    } else {
      candidates = options.band;
      predict(left, options.band, first, last, both.first_left);
      predict(right, options.band, first, last, both.first_right);
    }
    RELIEVO_TRY(match_both(from, to, candidates, options.costs, context, both));
    cross_check(both.left, both.right, options.cross_check_px);
    median3(both.left, context.scratch);
    median3(both.right, context.scratch);
    std::copy(both.left.values.begin(), both.left.values.end(), next_left.values.begin());
    std::copy(both.right.values.begin(), both.right.values.end(), next_right.values.begin());
    left = std::move(next_left);
    right = std::move(next_right);
    first *= 2;
    last *= 2;
    context.progress.done.store(0.2F * static_cast<float>(kCoarsest + 1 - level), std::memory_order_relaxed);
  }
  std::copy(left.values.begin(), left.values.end(), finest.values.begin());
  return {};
}

}  // namespace

Result<void> SgmMatcherOptions::check() const {
  if (finest < 0 || finest > 2 || band < 4 || band > 64)
    return Error{Errc::InvalidInput, "sgm: finest must lie in 0 .. 2 and band in 4 .. 64"};
  if (costs.step_penalty < 0 || costs.jump_penalty < costs.step_penalty || costs.jump_penalty > 1000)
    return Error{Errc::InvalidInput, "sgm: jump_penalty must be at least step_penalty, and at most 1000"};
  if (!(cross_check_px > 0)) return Error{Errc::InvalidInput, "sgm: cross_check_px must be positive"};
  return {};
}

Result<MatchSet> SgmMatcher::match(const RectifiedPair& pair, const Keypoints& keypoints, StageContext& context) const {
  if (pair.width_px < 64 || pair.height_px < 64 || pair.left.grey.empty() || pair.right.grey.empty())
    return Error{Errc::InvalidInput, "the rectified pair is smaller than 64 pixels"};
  MatchSet set(&context.output);
  set.lattice_step_px = keypoints.lattice_step_px;
  set.matches.reserve(keypoints.points.size());
  const int scale = 1 << options_.finest;
  Plane<float> field(&context.scratch, (pair.width_px + scale - 1) / scale, (pair.height_px + scale - 1) / scale);
  {
    Arena::Mark mark(context.scratch);
    RELIEVO_TRY(match_sizes(pair, options_, context, field));
  }
  std::pmr::vector<Match> found(keypoints.points.size(), Match{}, &context.scratch);
  const auto size = static_cast<float>(scale);
  context.pool.for_each_band(static_cast<int>(found.size()), kBands, [&](int begin, int end, int) {
    for (int k = begin; k < end && !context.stop(); ++k) {
      const Vec2f at = keypoints.points[static_cast<std::size_t>(k)].at_px;
      const FieldReading reading = read_disparity(field, {at.x / size, at.y / size}, kNoDisparity);
      if (!reading.known) continue;
      const float d = size * reading.disparity;
      found[static_cast<std::size_t>(k)] = {at, d, window_cost(pair, at, d, kCorrelationRadius), size * std::hypot(kFitPx, reading.scatter), 0};
    }
  });
  if (context.stop()) return Error{Errc::Cancelled, "stopped while matching"};
  for (const Match& match : found)
    if (match.sigma_px > 0 && match.cost < 1) set.matches.push_back(match);
  if (set.matches.empty())
    return Error{Errc::TooFewMatches, "hardly anything matches between the views: is the face in both, in focus and lit?"};
  return set;
}

}  // namespace relievo::pipeline

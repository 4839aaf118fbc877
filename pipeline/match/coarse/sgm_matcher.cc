// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/coarse/sgm_matcher.h"

#include <cmath>

#include "pipeline/match/coarse/size_ladder.h"
#include "pipeline/match/image/field_reader.h"
#include "pipeline/match/image/image_pyramid.h"
#include "pipeline/match/window/window_correlation.h"

namespace relievo::pipeline {
namespace {

constexpr int kCorrelationRadius = 4;
constexpr float kFitPx = 1.0F / 6;  // of the equiangular fit, pixels of the finest size
constexpr int kBands = 32;

}  // namespace

Result<void> SgmMatcher::check() const {
  if (coarsest < finest) return Error{Errc::InvalidInput, "coarsest must be at least finest"}.at("sgm");
  return {};
}

Result<MatchSet> SgmMatcher::match(const RectifiedPair& pair, const Keypoints& keypoints,
                                   StageContext& context) const {
  if (pair.width_px < 64 || pair.height_px < 64 || pair.left.grey.empty() || pair.right.grey.empty())
    return Error{Errc::InvalidInput, "the rectified pair is smaller than 64 pixels"};
  MatchSet set(&context.output);
  set.lattice_step_px = keypoints.lattice_step_px;
  set.matches.reserve(keypoints.points.size());
  const int scale = 1 << finest;
  Plane<float> field(&context.scratch, (pair.width_px + scale - 1) / scale,
                     (pair.height_px + scale - 1) / scale);
  {
    Arena::Mark mark(context.scratch);
    const Pyramids pyramids = build_pyramids(pair, coarsest + 1, context);
    const SizeLadder ladder{coarsest, finest, band, cross_check_px};
    RELIEVO_TRY(match_down(whole_range(pair), pyramids, ladder, costs, context, 0.8F, field));
  }
  std::pmr::vector<Match> found(keypoints.points.size(), Match{}, &context.scratch);
  const auto size = float(scale);
  context.pool.for_each_band(int(found.size()), kBands, [&](int begin, int end, int) {
    for (int k = begin; k < end && !context.stop(); ++k) {
      const Vec2f at = keypoints.points[std::size_t(k)].at_px;
      const FieldReading reading = read_disparity(field, {at.x / size, at.y / size}, kNoDisparity);
      if (!reading.known) continue;
      const float d = size * reading.disparity;
      found[std::size_t(k)] = {at, d, window_cost(pair, at, d, kCorrelationRadius),
                               size * std::hypot(kFitPx, reading.scatter), 0};
    }
  });
  if (context.stop()) return Error{Errc::Cancelled, "stopped while matching"};
  for (const Match& match : found)
    if (match.sigma_px > 0 && match.cost < 1) set.matches.push_back(match);
  if (set.matches.empty())
    return Error{Errc::TooFewMatches,
                 "hardly anything matches between the views: is the face in both, in focus and lit?"};
  return set;
}

}  // namespace relievo::pipeline

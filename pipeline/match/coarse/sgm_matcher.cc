// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/coarse/sgm_matcher.h"

#include "pipeline/match/coarse/size_ladder.h"
#include "pipeline/match/image/image_pyramid.h"
#include "pipeline/match/window/field_matches.h"

namespace relievo::pipeline {

Result<void> SgmMatcher::check() const {
  if (coarsest < finest) return Error{Errc::InvalidInput, "coarsest must be at least finest"}.at("sgm");
  return {};
}

Result<MatchSet> SgmMatcher::match(const RectifiedPair& pair, const Keypoints& keypoints,
                                   StageContext& context) const {
  if (pair.width_px < 64 || pair.height_px < 64 || pair.left.grey.empty() || pair.right.grey.empty())
    return Error{Errc::InvalidInput, "the rectified pair is smaller than 64 pixels"};
  const int scale = 1 << finest;
  DisparityField field{
      {&context.scratch, (pair.width_px + scale - 1) / scale, (pair.height_px + scale - 1) / scale},
      kNoDisparity,
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

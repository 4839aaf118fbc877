// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/window/window_matchers.h"

#include "pipeline/match/window/window_matching.h"

namespace relievo::pipeline {

Result<MatchSet> SsdMatcher::match(const RectifiedPair& pair, const Keypoints& keypoints,
                                   StageContext& context) const {
  const double most_unlike = double(max_difference) * double(max_difference);
  return match_windows(
      pair, keypoints,
      {WindowScore::SquaredDifferences, window_px, channels, false, most_unlike, sigma_limit_px}, context);
}

Result<MatchSet> ZmnccMatcher::match(const RectifiedPair& pair, const Keypoints& keypoints,
                                     StageContext& context) const {
  return match_windows(pair, keypoints,
                       {WindowScore::ZeroMeanCorrelation, window_px, channels, equiangular != 0,
                        1 - double(min_score), sigma_limit_px},
                       context);
}

}  // namespace relievo::pipeline

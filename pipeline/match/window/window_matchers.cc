// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/window/window_matchers.h"

#include "pipeline/match/window/window_matching.h"

namespace relievo::pipeline {

Result<MatchSet> SsdMatcher::match(const RectifiedPair& pair, const Keypoints& keypoints,
                                   StageContext& context) const {
  WindowRule rule;
  rule.score = WindowScore::SquaredDifferences;
  rule.window_px = window_px;
  rule.channels = channels;
  rule.most_unlike = double(max_difference) * double(max_difference);
  rule.sigma_limit_px = sigma_limit_px;
  return match_windows(pair, keypoints, rule, context);
}

Result<MatchSet> ZmnccMatcher::match(const RectifiedPair& pair, const Keypoints& keypoints,
                                     StageContext& context) const {
  WindowRule rule;
  rule.score = WindowScore::ZeroMeanCorrelation;
  rule.window_px = window_px;
  rule.channels = channels;
  rule.equiangular = equiangular != 0;
  rule.most_unlike = 1 - double(min_score);
  rule.sigma_limit_px = sigma_limit_px;
  return match_windows(pair, keypoints, rule, context);
}

}  // namespace relievo::pipeline

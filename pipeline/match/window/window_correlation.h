// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Zero-mean correlation of one window of the left view with one of the right, both anywhere between
// pixels (bilinear): how alike a match is, for matchers whose own score is none, and for constraints.
#pragma once

#include <optional>
#include <span>

#include "pipeline/base/stage.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/model/keypoint.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// One place of the left view looked for on its row of the right one, for a few places, where the matchers'
// tables would cost more than they save. Candidates are whole disparities, both ends included, a parabola
// goes through the best; sigma_px as in window_matchers.h, cost one minus the correlation. None where no
// window correlates, or the best lies at an end: what is looked for may be beyond. Pixels. Thread: any.
std::optional<Match> match_on_row(const RectifiedPair& pair, Vec2f left_px, double least_px, double most_px,
                                  int radius);

// -1 .. 1; 0 where a window is plain, leaves its picture or touches pixels that are not valid.
double window_correlation(const RectifiedPair& pair, Vec2f left_px, Vec2f right_px, int radius);

// One minus the correlation at a match, 0 .. 1.
float window_cost(const RectifiedPair& pair, Vec2f left_px, float disparity_px, int radius);

// Those of `found`, a match or none (sigma_px 0) a keypoint, that are matches. Error: `none`, where there are
// none.
Result<MatchSet> matches_of(std::span<const Match> found, const Keypoints& keypoints, const Error& none,
                            StageContext& context);
Error nothing_matches();  // TooFewMatches

// Keypoints matched by a dense field of disparities, for matchers that make one of the whole picture.
struct DisparityField {
  Plane<float> values;  // pixels of the field; kNoDisparity where it is unknown
  Vec2f corner_px{};    // of the field in the left view
  float scale = 1;      // of its pixels to the view's
};

// sigma_px is the fit's between pixels and the field's own scatter. Errors: Cancelled; TooFewMatches.
Result<MatchSet> matches_in_field(const DisparityField& field, const RectifiedPair& pair,
                                  const Keypoints& keypoints, StageContext& context);

}  // namespace relievo::pipeline

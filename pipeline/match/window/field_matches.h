// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keypoints matched by a dense field of disparities, for matchers that make one of the whole picture.
#pragma once

#include "pipeline/base/stage.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/model/keypoint.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

struct DisparityField {
  Plane<float> values;  // pixels of the field; `nothing` and below is unknown
  float nothing = 0;
  Vec2f corner_px{};  // of the field in the left view
  float scale = 1;    // of its pixels to the view's
};

// sigma_px is the fit's between pixels and the field's own scatter. Errors: Cancelled; TooFewMatches.
Error nothing_matches();
Result<MatchSet> matches_in_field(const DisparityField& field, const RectifiedPair& pair,
                                  const Keypoints& keypoints, StageContext& context);

}  // namespace relievo::pipeline

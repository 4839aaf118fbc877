// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Matcher: finds where each left keypoint appears in the right image. A keypoint without a
// believable partner is left out of the result.
// Errors: TooFewMatches, OutOfMemory, Cancelled, InvalidInput (a pair without pixels).
#pragma once

#include <string_view>

#include "pipeline/base/stage.h"
#include "pipeline/model/keypoint.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

class Matcher {
 public:
  virtual ~Matcher() = default;
  virtual std::string_view name() const = 0;
  virtual Result<MatchSet> match(const RectifiedPair& pair, const Keypoints& keypoints,
                                 StageContext& context) const = 0;
};

}  // namespace relievo::pipeline

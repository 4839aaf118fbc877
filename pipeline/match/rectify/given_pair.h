// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two pictures that are rectified already, as benchmarks give them: taken as they are, pixel for pixel. No
// rig is known: a nominal one stands in for algorithms that think in millimetres, so that disparities of the
// range lie between `near_mm` and `far_mm`. Depths in millimetres then mean nothing; disparities do.
// Memory: the pair in `output`. Errors: InvalidInput (empty, sizes that differ, an empty range), Cancelled.
#pragma once

#include "pipeline/base/stage.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/model/stereo_frame.h"

namespace relievo::pipeline {

struct DisparityRange {
  int least_px = 0;
  int most_px = 256;  // not reached
  Result<void> check() const;
};

Result<RectifiedPair> take_rectified(const StereoFrame& frame, const DisparityRange& range,
                                     StageContext& context);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From corners seen to a calibrated rig: each camera alone (Zhang 2000), then both together; views in
// which the two cameras disagree are found, named and left out (README.md says by which rule).
// Errors of calibrate(): InvalidInput (sizes, counts of corners), PoorGeometry (too few boards, or
// views that determine nothing; where() says how many).
// Thread: any; the same input gives the same result.
#pragma once

#include <vector>

#include "pipeline/calibrate/fit/calibrator_input.h"
#include "pipeline/calibrate/fit/fitted_views.h"
#include "pipeline/calibrate/quality/quality.h"
#include "pipeline/model/calibration.h"

namespace relievo::pipeline {

struct CalibratorOutput {
  StereoCalibration calibration;
  CalibrationQuality quality;     // with verdict Refuse the calibration is not to be used
  std::vector<FittedView> views;  // one a view given, in their order
};

Result<CalibratorOutput> calibrate(const CalibratorInput& input);

}  // namespace relievo::pipeline

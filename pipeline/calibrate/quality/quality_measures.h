// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The numbers of CalibrationQuality, from the fits. Inside calibrate/ only.
#pragma once

#include "pipeline/calibrate/fit/stereo_fit.h"
#include "pipeline/calibrate/quality/quality.h"

namespace relievo::pipeline {

struct Fitted {
  const CameraFits& cameras;
  std::span<const int> pairs;  // views with a board in both pictures, fit for use
  const Selection& selection;
};

// In both pictures: of a ChArUco board not all, nor of one with strays.
int corners_seen(const BoardView& view);

// Fills everything but verdict and reasons. quality.views must name all views already.
void measure_quality(const Fitted& fitted, CalibrationQuality& quality);

// Verdict and reasons, from the numbers.
void judge_quality(CalibrationQuality& quality);

}  // namespace relievo::pipeline

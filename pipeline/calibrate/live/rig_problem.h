// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A calibration as the bundle adjustment knows rigs. Inside calibrate/ only. Thread: any.
#pragma once

#include "pipeline/calibrate/calibrator.h"
#include "pipeline/calibrate/fit/bundle.h"

namespace relievo::pipeline {

// Without views, nothing free.
bundle::Problem rig_problem(const StereoCalibration& calibration, const BoardPattern& pattern);

// Where the board stands, from the left camera alone; good enough to start from.
bundle::Pose guessed_pose(const bundle::Problem& rig, const BoardCorners& left);

// The calibration's used views (the first of the input's) as a solved problem: it knows its information and
// covariance. False where they do not determine it.
bool solved_problem(const CalibratorInput& input, const CalibratorOutput& calibrated,
                    bundle::Problem& solved);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/swapped_pair.h"

#include <cmath>

#include "pipeline/calibrate/live/rig_problem.h"

namespace relievo::pipeline {
namespace {

// A rig known from few views may miss by pixels; an exchange makes it worse by far more than that.
constexpr double kSuspectPx = 1;
constexpr double kFarBetter = 0.3;

double rms_px(bundle::Problem rig, const BoardCorners& left, const BoardCorners& right) {
  rig.views.emplace_back(&left, &right, guessed_pose(rig, left));
  if (!bundle::solve_poses(rig)) return 1e9;
  return std::sqrt(2 * rig.squared_px / rig.residuals);
}

}  // namespace

bool is_exchanged(const StereoCalibration& calibration, const BoardPattern& pattern, const BoardCorners& left,
                  const BoardCorners& right) {
  const bundle::Problem rig = rig_problem(calibration, pattern);
  const double as_given = rms_px(rig, left, right);
  return as_given > kSuspectPx && rms_px(rig, right, left) < kFarBetter * as_given;
}

}  // namespace relievo::pipeline

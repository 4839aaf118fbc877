// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/rig_problem.h"

#include <algorithm>

#include "pipeline/calibrate/fit/stereo_fit.h"

namespace relievo::pipeline {
using bundle::Problem;

Problem rig_problem(const StereoCalibration& calibration, const BoardPattern& pattern) {
  Problem rig;
  rig.pattern = pattern;
  rig.camera = {calibration.left, calibration.right};
  const RigidTransform& relation = calibration.right_from_left;
  for (int i = 0; i < 9; ++i) rig.right_from_left.rotation(i / 3, i % 3) = relation.rotation.m[i];
  rig.right_from_left.translation_mm = {relation.translation_mm.x, relation.translation_mm.y,
                                        relation.translation_mm.z};
  return rig;
}

bundle::Pose guessed_pose(const Problem& rig, const BoardCorners& left) {
  Problem one;
  one.pattern = rig.pattern;
  one.camera[0].width_px = rig.camera[0].width_px;
  one.camera[0].height_px = rig.camera[0].height_px;
  one.views.emplace_back(&left, nullptr, bundle::Pose{});
  bundle::first_guess(one);
  bundle::Pose pose = one.views[0].left_from_board;
  pose.translation_mm.z() *= rig.camera[0].focal_px.x / one.camera[0].focal_px.x;
  return pose;
}

bool solved_problem(const CalibratorInput& input, const CalibratorOutput& calibrated, Problem& solved) {
  const Problem rig = rig_problem(calibrated.calibration, input.pattern);
  solved = rig;
  for (std::size_t v = 0; v < std::min(input.views.size(), calibrated.quality.views.size()); ++v) {
    if (!calibrated.quality.views[v].used) continue;
    const BoardView& view = input.views[v];
    Problem one = rig;
    one.views.emplace_back(&view.left, &view.right, guessed_pose(rig, view.left));
    if (!bundle::solve_poses(one)) return false;
    solved.views.push_back(one.views[0]);
  }
  solved.free.fill(true);
  for (const int eye : {0, 1}) set_priors(solved, eye);
  const double left = calibrated.quality.left_rms_px;
  const double right = calibrated.quality.right_rms_px;
  solved.noise_px2 = std::max(1e-6, 0.25 * (left * left + right * right));  // rms is of both coordinates
  return bundle::solve(solved);
}

}  // namespace relievo::pipeline

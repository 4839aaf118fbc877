// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fits the calibrator is made of. Inside calibrate/ only.
#pragma once

#include <span>
#include <vector>

#include "pipeline/calibrate/fit/bundle.h"
#include "pipeline/calibrate/fit/calibrator_input.h"

namespace relievo::pipeline {

// One camera alone. `views` are indices of its boards in the input.
struct CameraFit {
  std::vector<int> views;
  bundle::Problem problem;  // view k is input view views[k]
  double variance_px2 = 0;  // of one coordinate of a corner, the noise
  const CameraIntrinsics& camera() const { return problem.camera[0]; }
  double rms_px() const;  // over both coordinates of a corner

  // Of an input view: itself, sum of squares, its mean's root a corner, pose. Asserts that it is one of ours.
  const bundle::View& view(int of) const;
  double squared_px(int of) const;
  double rms_px(int of) const;
  const bundle::Pose& pose(int of) const;
};

// What lenses and sensors are like before the first picture is taken, one standard deviation: principal
// point 4 % of the longer side off the middle, k1 k2 k3 0.5, p1 p2 0.005, pixels square within 2 %.
// Wide enough for any lens a face is photographed with; the pictures soon know better. It takes the
// place of a choice of terms: nothing is fixed, and nothing runs away where the pictures are silent.
void set_priors(bundle::Problem& problem, int eye);

// False where nothing can be determined.
bool fit_camera(const CalibratorInput& input, bool right, std::span<const int> views, CameraFit& fit);

// Both cameras. Views in `paired` tie the cameras together; every other board still speaks for the
// camera that saw it, so that a pair left out costs nothing of the lenses' calibration.
struct StereoFit {
  bundle::Problem problem;  // the first paired.size() views are the paired ones, in order
  std::vector<int> paired;
  std::vector<int> views;  // of the input, in the problem's order
  double paired_squared_px = 0;
  int paired_corners = 0;  // of left and right together
  double rms_px() const;   // of the paired views
};

struct CameraFits {
  const CameraFit& left;
  const CameraFit& right;

  // No corner is known better than to a thousandth of a pixel.
  double noise_px2() const;
};

// Cameras and poses of `start` are where it begins, if given: a fit of nearly the same views is done in
// two or three steps from there.
// slip: variance of the pairs' disagreement over that of the corners, 1 for a firm rig. What slips says
// little of the lenses: each camera's own boards count `slip` times as much as its ties to the other.
bool fit_stereo(const CalibratorInput& input, const CameraFits& cameras, std::span<const int> paired,
                const bundle::Pose& relation, double slip, const StereoFit* start, StereoFit& fit);
bundle::Pose relation_of(const CameraFits& cameras, int view);

// Sum of squares of each view of `views` as a pair under the fit's cameras, board pose free.
std::vector<double> judge_pairs(const CalibratorInput& input, const CameraFits& cameras, const StereoFit& fit,
                                std::span<const int> views, std::vector<bundle::View>* judged = nullptr);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fits the calibrator is made of. Inside calibrate/ only.
#pragma once

#include <span>
#include <vector>

#include "pipeline/calibrate/fit/bundle.h"
#include "pipeline/calibrate/calibrator.h"

namespace relievo::pipeline {

// One camera alone. `views` are indices of its boards in the input.
struct CameraFit {
  CameraIntrinsics camera;
  std::vector<int> views;
  bundle::Problem problem;  // view k is input view views[k]
  double variance_px2 = 0;  // of one coordinate of a corner, the noise
  double rms_px() const;    // over both coordinates of a corner

  // Sum of squares of an input view; its pose. Asserts that the view is one of ours.
  double squared_px(int view) const;
  int corners(int view) const;
  const bundle::Pose& pose(int view) const;
};

// distortion_terms: how many of k1 k2 p1 p2 k3. False where nothing can be determined.
bool fit_camera(const CalibratorInput& input, bool right, std::span<const int> views, int distortion_terms,
                CameraFit& fit);

// How many distortion terms the pictures pay for: more only where boards that had no part in the fit
// are predicted better, by more than the standard error of that gain.
int choose_distortion_terms(const CalibratorInput& input, std::span<const int> left,
                            std::span<const int> right);

// Both cameras. Views in `paired` tie the cameras together; every other board still speaks for the
// camera that saw it, so that a pair left out costs nothing of the lenses' calibration.
struct StereoFit {
  bundle::Problem problem;  // the first paired.size() views are the paired ones, in order
  std::vector<int> paired;
  double paired_squared_px = 0;
  int paired_corners = 0;  // of left and right together
  double rms_px() const;   // of the paired views
};

struct CameraFits {
  const CameraFit& left;
  const CameraFit& right;
  int distortion_terms;
};

bool fit_stereo(const CalibratorInput& input, const CameraFits& cameras, std::span<const int> paired,
                const bundle::Pose& start, bool refine_cameras, StereoFit& fit);
bundle::Pose relation_of(const CameraFits& cameras, int view);

// Sum of squares of each view of `views` as a pair under the fit's cameras, board pose free.
std::vector<double> judge_pairs(const CalibratorInput& input, const CameraFits& cameras, const StereoFit& fit,
                                std::span<const int> views, std::vector<bundle::View>* judged = nullptr);

}  // namespace relievo::pipeline

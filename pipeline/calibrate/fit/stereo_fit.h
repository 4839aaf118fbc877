// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fits the calibrator is made of. Inside calibrate/ only.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/calibrate/fit/bundle.h"

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
  double squared_px(int of) const { return view(of).squared_px[0]; }
  double rms_px(int of) const { return std::sqrt(squared_px(of) / view(of).corners[0]); }
  const bundle::Pose& pose(int of) const { return view(of).left_from_board; }
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
  const CalibratorInput& input;
  const CameraFit& left;
  const CameraFit& right;

  double squared_px(int pair) const { return left.squared_px(pair) + right.squared_px(pair); }
  // No corner is known better than to a thousandth of a pixel.
  double noise_px2() const;
};

// Cameras and poses of `start` are where it begins, if given: a fit of nearly the same views is done in
// two or three steps from there.
// slip: variance of the pairs' disagreement over that of the corners, 1 for a firm rig. What slips says
// little of the lenses: each camera's own boards count `slip` times as much as its ties to the other.
bool fit_stereo(const CameraFits& cameras, std::span<const int> paired, const bundle::Pose& relation,
                double slip, const StereoFit* start, StereoFit& fit);
bundle::Pose relation_of(const CameraFits& cameras, int view);

// The excess of each view of `views`: what its sum of squares as a pair, under the fit's cameras and the
// board's pose free, is above that of each camera alone.
std::vector<double> judge_pairs(const CameraFits& cameras, const StereoFit& fit, std::span<const int> views,
                                std::vector<bundle::View>* judged = nullptr);

// Which views agree on where the right camera stands.
//
// A pair of pictures in which both cameras hold still adds six numbers of freedom (the board's pose)
// less than two cameras alone would need: its excess, the sum of squares with the rig rigid minus
// the sum with each camera alone, is noise * chi-square of 6. Views that moved have more.
//  1. The half of the views with the least excess together (least trimmed squares with concentration
//     steps, Rousseeuw and Van Driessen 2006), started from the relation each view alone suggests.
//  2. Forward search (Atkinson and Riani 2000): the view whose admission costs least is let in as long
//     as its cost is no surprise (F test of 6 degrees of freedom against the views already in).
//  3. Where a lasting change is found along the sequence, only the side with more of them is used.
// The yardstick is the spread of the agreeing views themselves, never less than the corner noise: on
// a rig that shakes, shaking is normal, and what is left out is what stands out of that.

// Where a lasting change of disagreement lies: index into the excesses of the last view before it,
// with the range a likelihood ratio at 1 % leaves open; -1 without one.
struct ChangePoint {
  int likeliest = -1;
  int first = -1;
  int last = -1;
};

struct Selection {
  StereoFit fit;               // of the views used
  std::vector<double> excess;  // one a pair given, px² summed, under the fit they were chosen by
  ChangePoint moved;           // by place among the pairs; only one side of it is used
  double spread_px2 = 0;       // excess of the used views for one degree of freedom
};

bool select_views(const CameraFits& cameras, std::span<const int> pairs, Selection& out);

// Does the pairs' disagreement look more like a board that was carried on between the two exposures than like
// a right camera that turned about its own centre in every view? Three numbers of freedom a view, the
// relation fitted anew under either story.
bool board_carried_on(const CameraFits& cameras, std::span<const int> pairs,
                      const bundle::Pose& right_from_left);

}  // namespace relievo::pipeline

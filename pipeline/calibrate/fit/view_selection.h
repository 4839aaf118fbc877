// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which views agree on where the right camera stands. Inside calibrate/ only.
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
#pragma once

#include <span>
#include <vector>

#include "pipeline/calibrate/fit/stereo_fit.h"

namespace relievo::pipeline {

// Normal deviate above which a view is left out: one good view in some 30,000.
inline constexpr double kSurprise = 4.0;

// Where a lasting change of disagreement lies: index into the excesses of the last view before it,
// with the range a likelihood ratio at 1 % leaves open; -1 without one.
struct ChangePoint {
  int likeliest = -1;
  int first = -1;
  int last = -1;
};
ChangePoint change_point(std::span<const double> excess, double spread_px2);

struct Selection {
  StereoFit fit;
  std::vector<int> used;       // sorted
  std::vector<double> excess;  // one a pair given, px² summed, under the fit they were chosen by
  ChangePoint moved;           // by place among the pairs; only one side of it is used
  double spread_px2 = 0;       // excess of the used views for one degree of freedom
};

bool select_views(const CalibratorInput& input, const CameraFits& cameras, std::span<const int> pairs,
                  Selection& out);

// What each pair of pictures alone says about where the right camera stands, to second order: enough to try
// many subsets of the views without a single bundle adjustment.

// A board as each camera alone sees it, and how firmly (information of the pose, corners of 1 px noise).
struct RelationEvidence {
  bundle::Pose left_from_board;
  bundle::Pose right_from_board;
  bundle::Matrix6d left_information;
  bundle::Matrix6d right_information;
};

// One a view, in the order of `pairs`.
std::vector<RelationEvidence> gather_evidence(const CameraFits& cameras, std::span<const int> pairs);

// What the view's sum of squares grows by when the right camera stands at `right_from_left` (px²).
double misfit_px2(const RelationEvidence& view, const bundle::Pose& right_from_left);

// The relation under which the misfits of `chosen` (places in `views`) sum to the least, from a start.
bundle::Pose fit_relation(std::span<const RelationEvidence> views, std::span<const std::size_t> chosen,
                          bundle::Pose right_from_left);

// What stays of the misfit of all views (px²) when in every view the right camera may have turned about
// its own centre, and when instead the board may have been carried on between the two exposures: three
// numbers of freedom a view each, the relation fitted anew under either story.
struct Stories {
  double camera_turned_px2 = 0;
  double board_carried_px2 = 0;
};
Stories tell_stories(std::span<const RelationEvidence> views, const bundle::Pose& right_from_left);

}  // namespace relievo::pipeline

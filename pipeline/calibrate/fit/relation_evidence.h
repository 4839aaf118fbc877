// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What each pair of pictures alone says about where the right camera stands, to second order: enough
// to try many subsets of the views without a single bundle adjustment.
// Inside calibrate/ only. Thread: any.
#pragma once

#include <span>
#include <vector>

#include "pipeline/calibrate/fit/stereo_fit.h"

namespace relievo::pipeline {

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

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which view to take next: of some 250 poses that both cameras would see whole, the one after which
// the depth error would be smallest. Information adds up: what a view adds is known before it is taken
// (its corners' derivatives need no picture), and the covariance after it is the inverse of the sum
// (optimal design of experiments, A criterion; Atkinson and Donev 1992). Where the coverage bars are not
// full, filling them counts, too: they guard against what the model of the lens leaves out.
// Inside calibrate/ only. Thread: any. The same input gives the same plan.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "pipeline/calibrate/calibrator.h"
#include "pipeline/calibrate/fit/bundle.h"
#include "pipeline/calibrate/live/live_state.h"
#include "pipeline/calibrate/live/view_target.h"
#include "pipeline/calibrate/live/watch/board_parameters.h"

namespace relievo::pipeline {

// A calibration as the bundle adjustment knows rigs, without views, nothing free.
bundle::Problem rig_problem(const StereoCalibration& calibration, const BoardPattern& pattern);

// A rig that sees one board, which is put where it fits best. False where it fits nowhere.
bool lay_board(bundle::Problem& rig, const BoardCorners& left, const BoardCorners& right);

// Poses in which a person can hold a board so that both cameras of a rig see it whole: nine places in
// the picture, as far out as may be, at three distances, facing the camera and tilted eight ways.
struct CandidatePose {
  std::size_t number = 0;  // always the same for the same pose of the list
  bundle::Pose left_from_board;
  std::array<BoardCorners, 2> corners;  // as the two cameras would see them
};

// `quarter_turns`: how the person holds the board, clockwise from rows that run to the right.
std::vector<CandidatePose> candidate_poses(const bundle::Problem& rig, double distance_mm, int quarter_turns);

struct ViewPlan {
  std::optional<PlannedView> best;  // none when no candidate is new
  double best_worth = 0;            // of it
  double best_gain = 0;             // share by which the best candidate (for the error alone) lowers it
  double best_bar_gain = 0;         // what the best candidate (for the bars alone) adds to them, summed
};

// Of enough views: is this the end, as no further one would help? `reached`: the goal. Without a plan nobody
// knows what would help, and it goes on.
LiveEnd end_of(const std::optional<ViewPlan>& plan, bool reached, double plateau_gain);

// One view in both cameras.
using ViewParameters = std::array<BoardParameters, 2>;
using TakenViews = std::span<const ViewParameters>;

// Is it `times` as far from each view taken as the least that counts as new, in either camera?
bool is_new(const ViewParameters& view, TakenViews taken, double times);

using DepthByGlobals = Eigen::Matrix<double, 9, bundle::kGlobals>;

class ViewPlanner {
 public:
  // What is known now: the views with their calibration, and the error it promises. False where these
  // views do not determine the rig; it then knows what it knew before.
  bool update(const CalibratorInput& input, const CalibratorOutput& now, double error_mm, TakenViews taken,
              const std::array<Coverage, 2>& coverage, const LiveOptions& options);

  // The following need one update() that succeeded.
  // Candidates in `excluded` are passed over.
  ViewPlan plan(std::span<const std::size_t> excluded) const;
  // Of a view that both cameras have before them, on the scale of best_worth.
  double worth(const BoardCorners& left, const BoardCorners& right) const;

 private:
  ViewParameters parameters(const BoardCorners& left, const BoardCorners& right) const;
  double error_gain(const bundle::View& view) const;
  double bar_gain(const ViewParameters& view) const;
  double worth(double error_gain, double bar_gain) const;

  LiveOptions options_;
  bundle::Problem rig_;          // without views
  bundle::GlobalVector unit_;    // of each global, one standard deviation
  bundle::Globals information_;  // in these units
  DepthByGlobals depth_;         // of the field's points, by one unit of each global
  double variance_ = 0;          // of the depths, mean, noise of 1 px
  double error_mm_ = 0;
  std::vector<ViewParameters> taken_;
  std::array<Coverage, 2> coverage_;
  int quarter_turns_ = 0;  // how the person holds the board
};

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a live calibration is asked for.
#pragma once

#include <optional>

#include "hal/base/result.h"
#include "pipeline/model/calibration.h"

namespace relievo::pipeline {

struct LiveOptions {
  double goal_mm = 0.1;      // of the predicted error of distances, one standard deviation,
  double distance_mm = 560;  // at this distance, 400 to 750
  double full_bar = 0.8;     // what every coverage bar shall reach
  int min_views = 10;
  int max_views = 40;          // bounds memory and time, too
  double plateau_gain = 0.02;  // it ends when no candidate view lowers the predicted error by this share
  double still_px = 2;         // root mean square of the corners' motion since the pair before
  double edge_px = 4;          // width of the board's edges, 10 to 90 % (board_tracker.h)
  double new_distance = 0.2;   // distance_between() to every view taken, in either camera
  double least_worth = 0.3;  // of a view, once the cameras are known: share of what the best one would bring
  int patience_pairs = 100;  // on the way to one target, before another is chosen

  double expected_baseline_mm = 0;  // these two as in CalibratorInput
  std::optional<StereoCalibration> in_use{};

  Result<void> check() const;  // InvalidInput
};

}  // namespace relievo::pipeline

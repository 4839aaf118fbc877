// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/live_options.h"

#include "pipeline/calibrate/calibrator.h"
#include "pipeline/calibrate/quality/uncertainty.h"

namespace relievo::pipeline {

Result<void> LiveOptions::check() const {
  const auto within = [](double value, double least, double most) { return value >= least && value <= most; };
  if (!within(goal_mm, 0.001, 100))
    return Error{Errc::InvalidInput, "the goal must be 0.001 to 100 mm"}.at("goal_mm");
  if (!within(distance_mm, kFirstDepthMm, kFirstDepthMm + (kDepthSteps - 1) * kDepthStepMm))
    return Error{Errc::InvalidInput, "the error is predicted for distances of 400 to 750 mm"}.at(
        "distance_mm");
  if (!within(full_bar, 0, 1))
    return Error{Errc::InvalidInput, "a coverage bar goes from 0 to 1"}.at("full_bar");
  if (min_views < kMinBoardPairs || max_views < min_views || max_views > kMaxBoardPairs)
    return Error{Errc::InvalidInput, "wants 5 <= min_views <= max_views <= 500"}.at("min_views, max_views");
  if (!within(plateau_gain, 0, 0.5)) return Error{Errc::InvalidInput, "must be 0 to 0.5"}.at("plateau_gain");
  if (!within(still_px, 0.01, 1000))
    return Error{Errc::InvalidInput, "must be 0.01 to 1000 px"}.at("still_px");
  if (!within(edge_px, 0.5, 100)) return Error{Errc::InvalidInput, "must be 0.5 to 100 px"}.at("edge_px");
  if (!within(new_distance, 0, 4)) return Error{Errc::InvalidInput, "must be 0 to 4"}.at("new_distance");
  if (!within(least_worth, 0, 1)) return Error{Errc::InvalidInput, "must be 0 to 1"}.at("least_worth");
  if (patience_pairs < 1) return Error{Errc::InvalidInput, "must be at least 1"}.at("patience_pairs");
  return {};
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ViewCollector: decides which views of a board a live calibration takes, recalculates after each, says
// what to show next and when it is enough. It sees corners, no pictures; LiveCalibration brings them.
//
//   Opening --5th view that determines the cameras--> Improving --goal and bars, plateau, or full--> Done
//      |                                                  |
//      +---- the left camera stands right of the right one +--> Swapped
//
// Every pair: consider(); where it returns true the view is wanted, and take() or pass() must follow.
//   Opening    targets are tilts, told from the picture alone
//   Improving  targets are the poses that lower the predicted error most (view_planner.h)
//   Done, Swapped  take nothing more; finish() gives the calibration, of Swapped its error
//
// Takes a view when both cameras see the board whole, it held still, its edges are sharp, it is new (and,
// once the cameras are known, worth a part of what the best view would be), and the state allows it; the
// verdict names the first of these that fails. The same input gives the same states. Memory:
// options.max_views views of the pattern's corners, and nothing else that grows. Time: most pairs cost next
// to nothing, a view that is taken costs one calibrate() and one plan. Errors: InvalidInput (wrong options,
// another number of corners, time that runs backwards). Thread: one.
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "pipeline/calibrate/calibrator.h"
#include "pipeline/calibrate/live/live_state.h"
#include "pipeline/calibrate/live/view_target.h"
#include "pipeline/calibrate/live/watch/board_tracker.h"

namespace relievo::pipeline {

struct PairDetection {
  std::array<BoardDetection, 2> seen;  // left, right
  std::chrono::nanoseconds at{0};      // since any beginning
};

class ViewPlanner;

class ViewCollector {
 public:
  // Errors: InvalidInput.
  static Result<ViewCollector> begin(const BoardPattern& pattern, int width_px, int height_px,
                                     const LiveOptions& options);

  ViewCollector(ViewCollector&& other) noexcept;
  ViewCollector& operator=(ViewCollector&& other) noexcept;
  ~ViewCollector();

  Result<bool> consider(PairDetection pair);
  // The wanted view with its precise corners.
  Result<void> take(BoardCorners left, BoardCorners right);
  // The wanted view turned out not to be whole at full size.
  void pass(bool left_whole, bool right_whole);

  const LiveState& state() const { return state_; }
  const CalibratorInput& views() const { return input_; }
  // Of the views so far; none before the first that worked.
  const std::optional<CalibratorOutput>& newest() const { return newest_; }
  Result<CalibratorOutput> finish() const;  // calibrate()'s errors

 private:
  ViewCollector(const BoardPattern& pattern, int width_px, int height_px, const LiveOptions& options);
  Result<void> check(const PairDetection& pair) const;
  PairVerdict judge(const PairDetection& pair) const;
  bool is_new() const;
  void recalculate();
  void aim();
  void advise();
  LiveAdvice advice_for_verdict();
  LiveAdvice towards_target();
  void give_up_target();

  LiveOptions options_;
  CalibratorInput input_;
  LiveState state_;
  bool swapped_ = false;
  std::optional<PairDetection> last_;                  // the pair before
  std::array<BoardParameters, 2> now_{};               // of the newest pair
  std::vector<std::array<BoardParameters, 2>> taken_;  // one a view
  std::array<Coverage, 2> coverage_;
  std::optional<CalibratorOutput> newest_;
  std::unique_ptr<ViewPlanner> planner_;
  double best_worth_ = 0;  // of the planner's best view; 0: nothing is planned
  PlannedView target_;
  std::vector<std::size_t> given_up_;  // targets, since the last view
  Guide guide_;
  int pairs_on_target_ = 0;
  int useless_pairs_ = 0;  // at the target, and yet nothing new
};

}  // namespace relievo::pipeline

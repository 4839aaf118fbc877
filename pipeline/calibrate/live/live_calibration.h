// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LiveCalibration: pairs of pictures in, a calibration out, and at any time what a screen shows of it.
// It follows the board in reduced pictures, both cameras at once on the pool, and looks at full size
// only where ViewCollector wants the view.
// The same pairs give the same states, for any number of threads.
//
// Errors of look(): InvalidInput (no picture, left and right or one pair and the next differ in size,
// time that runs backwards), find_board()'s own; the pair then counts for nothing. What the person can
// help is advice in state(), never an error.
// Thread: one; the pool's threads work inside look() only.
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "hal/base/image_view.h"
#include "hal/base/thread_pool.h"
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

// ViewCollector: decides which views of a board a live calibration takes, recalculates after each, says
// what to show next and when it is enough. It sees corners, no pictures.
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

class LiveCalibration {
 public:
  // The pool must outlive this. Errors: InvalidInput.
  static Result<LiveCalibration> begin(const BoardPattern& pattern, const LiveOptions& options,
                                       ThreadPool& pool);

  Result<void> look(const ImageView& left, const ImageView& right, std::chrono::nanoseconds at);
  const LiveState& state() const { return collector_ ? collector_->state() : nothing_yet_; }
  // Errors: InvalidState (before the first pair), calibrate()'s own.
  Result<CalibratorOutput> finish() const;
  void restart();  // forgets every view

 private:
  LiveCalibration(const BoardPattern& pattern, const LiveOptions& options, ThreadPool& pool);
  Result<void> take(const std::array<ImageView, 2>& pictures);

  BoardPattern pattern_;
  LiveOptions options_;
  ThreadPool* pool_;
  std::array<BoardTracker, 2> tracker_;
  std::optional<ViewCollector> collector_;  // with the first pair, which says how large pictures are
  LiveState nothing_yet_;
};

}  // namespace relievo::pipeline

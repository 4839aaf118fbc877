// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LiveCalibration: pairs of pictures in, a calibration out, and at any time what a screen shows of it.
// It follows the board in reduced pictures, both cameras at once on the pool, and looks at full size
// only where ViewCollector wants the view; view_collector.h says which views that are, and has the states.
// The same pairs give the same states, for any number of threads.
//
// Errors of look(): InvalidInput (no picture, left and right or one pair and the next differ in size,
// time that runs backwards), find_board()'s own; the pair then counts for nothing. What the person can
// help is advice in state(), never an error.
// Thread: one; the pool's threads work inside look() only.
#pragma once

#include <chrono>
#include <memory>

#include "hal/base/image_view.h"
#include "hal/base/thread_pool.h"
#include "pipeline/calibrate/live/view_collector.h"
#include "pipeline/calibrate/live/watch/board_tracker.h"

namespace relievo::pipeline {

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
  std::unique_ptr<ViewCollector> collector_;  // with the first pair, which says how large pictures are
  LiveState nothing_yet_;
};

}  // namespace relievo::pipeline

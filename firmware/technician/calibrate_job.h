// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CalibrateJob: a live calibration (pipeline/calibrate/live) on pairs of the cameras, or of whoever holds a
// board before them; its state and its pictures, with the corners seen (green) and the wanted board's outline
// (orange) drawn in, go to the screen. Ends when the calibration is done, when it is told to finish with the
// views it has, or cancelled. Cameras that give no pair are tried again for some seconds; what goes wrong for
// longer, or with a pair itself, ends it, and the views it has are judged all the same.
// Errors of run(): LiveCalibration's and, where the views do not make a calibration, the pairs' own;
// Cancelled. Thread: run() capture; newest(), finish() any; the rest main, while it does not run.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "firmware/calibrate/calibrate_live.h"
#include "firmware/capture/live_feed.h"
#include "firmware/work/jobs.h"
#include "pipeline/calibrate/live/live_calibration.h"
#include "ui/technician/technician_view.h"

namespace relievo::firmware {

// Who shows boards instead of the cameras; empty: the cameras do.
using ShowBoards = std::function<Result<std::unique_ptr<LivePairs>>(const BoardArgs& board)>;

class CalibrateJob final : public CameraJob {
 public:
  struct Order {
    BoardArgs board;
    std::optional<pipeline::StereoCalibration> in_use;
  };
  CalibrateJob(StereoGrabber& grabber, EnrolmentSession& session, hal::Device& device, ThreadPool& pool,
               ShowBoards show)
      : CameraJob(grabber, session, device), pool_(pool), show_(std::move(show)) {}
  void order(const Order& order);
  Result<void> run(JobControl& control) override;
  void finish() { finish_.store(true, std::memory_order_relaxed); }

  // The live part of the view: pictures, advice, bars, all of one pair; and what keeps the next from coming.
  ui::TechnicianCalibration newest();
  const Result<void>& outcome() const { return outcome_; }
  const std::optional<pipeline::CalibratorOutput>& result() const { return result_; }
  void wipe();

 private:
  Result<void> calibrate(JobControl& control);
  // False: there are no more pairs.
  Result<bool> look_at_next(LivePairs& pairs, pipeline::LiveCalibration& live);
  // Goes with the next pair.
  void tell(const Error& trouble);
  bool may_pass(const Error& trouble) const;
  void publish(const LivePair& pair, const pipeline::LiveState& state);

  ThreadPool& pool_;
  ShowBoards show_;
  Order order_;
  std::array<LiveFeed, 2> feeds_;
  std::atomic<bool> finish_{false};
  std::mutex mutex_;
  ui::TechnicianCalibration figures_;  // without pictures, which the feeds have; all under the mutex
  std::optional<pipeline::CalibratorOutput> result_;
  Result<void> outcome_;
};

}  // namespace relievo::firmware

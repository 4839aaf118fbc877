// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CalibrationController: the technician's page on calibrations: which board is shown, the live calibration
// with its verdict, what is stored and which of it is in use; calibrations to a stick and from it. A refused
// calibration cannot be stored.
//
//   idle --begin()--> running (the machine's state Calibrate) --ended--> verdict --store()--> history
//
// Thread: main; store and pipelines are the keeper's. Errors: none are returned, view() has them as a
// sentence.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "firmware/base/list_walk.h"
#include "firmware/calibrate/calibrate_live.h"
#include "firmware/capture/live_feed.h"
#include "firmware/records/event_log.h"
#include "firmware/service/side_tasks.h"
#include "firmware/work/jobs.h"
#include "firmware/work/pipeline_stages.h"
#include "pipeline/calibrate/live/live_calibration.h"
#include "storage/store.h"
#include "ui/technician/technician_view.h"
#include "ui/view/staff_request.h"

namespace relievo::firmware {

// CalibrateJob: a live calibration (pipeline/calibrate/live) on pairs of the cameras, or of whoever holds a
// board before them; its state and its pictures, with the corners seen (green) and the wanted board's outline
// (orange) drawn in, go to the screen. Ends when the calibration is done, when it is told to finish with the
// views it has, or cancelled.
// Errors of run(): LiveCalibration's, the pairs' own, Cancelled. Thread: run() capture; newest(), finish()
// any; the rest main, while it does not run.

// Who shows boards instead of the cameras; empty: the cameras do.
using ShowBoards = std::function<Result<std::unique_ptr<LivePairs>>(const BoardArgs& board)>;

class CalibrateJob final : public Job {
 public:
  struct Order {
    BoardArgs board;
    std::optional<pipeline::StereoCalibration> in_use;
  };
  CalibrateJob(StereoGrabber& grabber, EnrolmentSession& session, hal::Device& device, ThreadPool& pool,
               ShowBoards show)
      : grabber_(grabber), session_(session), device_(device), pool_(pool), show_(std::move(show)) {}
  void order(const Order& order);
  Result<void> run(JobControl& control) override;
  void finish() { finish_.store(true, std::memory_order_relaxed); }

  // The live part of the view: pictures, advice, bars, all of one pair.
  ui::TechnicianCalibration newest();
  const Result<void>& outcome() const { return outcome_; }
  const std::optional<pipeline::CalibratorOutput>& result() const { return result_; }
  void wipe();

 private:
  Result<void> calibrate(JobControl& control);
  void publish(const LivePair& pair, const pipeline::LiveState& state);

  StereoGrabber& grabber_;
  EnrolmentSession& session_;
  hal::Device& device_;
  ThreadPool& pool_;
  ShowBoards show_;
  Order order_;
  std::array<LiveFeed, 2> feeds_;
  std::atomic<bool> finish_{false};
  std::mutex mutex_;
  ui::TechnicianCalibration figures_;  // without pictures and texts; with those of the feeds, under the mutex
  std::optional<pipeline::CalibratorOutput> result_;
  Result<void> outcome_;
};

class CalibrationController {
 public:
  struct Parts {
    const Appliance& appliance;
    CalibrateJob& job;
    PipelineStages& stages;  // replaced when another calibration comes into use
    storage::Store& store;
    EventLog& log;
    SideTasks& side_tasks;
    hal::Device& device;
    std::function<void(const pipeline::StereoCalibration&)> in_use;  // told when one did
  };
  explicit CalibrationController(Parts parts) : parts_(std::move(parts)) {}

  // The board, the stored ones; beginning and stopping are the test capture's, since the machine takes part.
  void act(const ui::TechnicianRequest& request);
  CalibrateJob::Order order() const;
  void begun();
  // The job has.
  void ended();
  void load_history();
  void walk(const ui::ListRequest& request);
  ui::TechnicianCalibration view();
  void forget();
  bool running() const { return running_; }
  // Visitors are measured with it from now on, or, if one is here, as soon as that visit has ended.
  // `calibrated`: its calibration is another one.
  void use(pipeline::Pipeline pipeline, bool calibrated);
  // What is in use, or soon will be. Main; on the keeper within a side task, since use() waits for those.
  const pipeline::AlgorithmSet& algorithms() const;
  const pipeline::StereoCalibration* calibration() const;
  // Every turn of the main loop, also when the technician has gone.
  void turn();

 private:
  void change_board(const ui::ChangeBoard& change);
  struct Row {
    storage::CalibrationInfo info;
    std::string made_at;
  };
  void store();
  void activate(std::size_t row);
  // By stick (stick_files.h). None of another size than the cameras' pictures comes into use.
  void export_in_use();
  void import_one();
  // Makes it the one in use, once the keeper has done `first`, which names it. `calibrated`: by which of the
  // job's runs it was made; 0: by none.
  void adopt(std::function<Result<std::uint32_t>()> first, std::uint32_t calibrated = 0);

  Parts parts_;
  BoardArgs board_{10, 7, 20};
  bool mounted_anew_ = false;  // the next calibration need not have the cameras' distance of the one in use
  bool running_ = false, ended_ = false, stored_ = false;
  std::uint32_t runs_ = 0;  // of the job
  ui::Fault problem_;
  std::string exported_;  // the folder on the stick
  std::vector<std::string> reasons_;
  std::vector<float> views_px_;
  std::vector<Row> history_;
  ListWalk walk_{ui::kCalibrationRows};
  bool busy_ = false;        // the keeper is at it
  std::uint32_t visit_ = 0;  // what a visit to the pages before this one asked for is not told here
  std::optional<pipeline::Pipeline> next_;  // comes into use when nobody is measured
  bool next_calibrated_ = false;
};

}  // namespace relievo::firmware

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TestCapture: what the technician's picture pages work on. A test capture is a session without a subject:
// its pictures and what the stages make of them lie in the appliance's own memory while the state is
// Staff, and are wiped when the technician leaves or is away too long. Its jobs run on the appliance's
// threads; the screen never waits.
//
//   Empty --Capture--> Capturing --> Running --> Ready or Failed --Run--> Running ...     another state -->
//   Empty any but Capturing and Running --Load--> Running --> Ready or Failed: what was saved, with its
//   calibration and algorithms
//
// It borrows the session from the appliance and sends its work as side tasks (firmware/service/side_tasks.h);
// it listens only in the states Staff and Calibrate, and forgets everything in any other. Thread: main.
// Errors: none are returned; the view has them as a sentence.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "firmware/appliance/appliance.h"
#include "firmware/records/event_log.h"
#include "firmware/service/side_tasks.h"
#include "firmware/technician/algorithm_controller.h"
#include "firmware/technician/calibration_controller.h"
#include "firmware/technician/camera_watch.h"
#include "firmware/technician/kept_results.h"
#include "firmware/technician/recording_controller.h"
#include "firmware/technician/run_job.h"
#include "firmware/technician/show/hand_pairs.h"
#include "firmware/technician/show/technician_tables.h"
#include "ui/technician/technician_view.h"

namespace relievo::firmware {

class TestCapture {
 public:
  struct Parts {
    Appliance& appliance;
    SideTasks& side_tasks;
    hal::Device& device;
    PipelineStages& stages;
    ThreadPool& pool;
    storage::Store& store;
    EventLog& log;
    ShowBoards show_boards;                                          // see CalibrateJob
    std::function<void(const pipeline::StereoCalibration&)> in_use;  // another calibration is
  };
  explicit TestCapture(Parts parts);
  ~TestCapture();
  TestCapture& operator=(TestCapture&&) = delete;

  // What a page asked for.
  void act(const ui::TechnicianRequest& request);
  // What a page has under way only while it is open begins and ends with it.
  void opened(ui::StaffPage page);
  void closed(ui::StaffPage page);
  // Every turn of the main loop, whatever page is open.
  void turn();
  // Valid until the next turn() or act().
  const ui::TechnicianView& view();

 private:
  enum class Next : std::uint8_t { None, Shot, Side, Calibration, Loaded };  // waits for the capture thread
  bool at_rest() const {
    return told_.phase == ui::TechnicianPhase::Ready || told_.phase == ui::TechnicianPhase::Failed;
  }
  Products* products() { return at_rest() && session_.is_open() ? &session_.products() : nullptr; }
  TechnicianTables::Source source() { return {products(), run_.figures(), calibration()}; }
  void leave();
  void wait_for_cameras(Next what);
  void begin_next();
  void forget_capture();
  void shoot(bool side);
  void calibrate();
  void run(std::int64_t latest);
  void send_run();
  void save();
  void load(std::size_t row, bool beside);
  void take_over();
  const pipeline::StereoCalibration* calibration() const;
  void stop();
  void shot_done(const std::optional<Error>& error);
  void run_done(const std::optional<Error>& error);
  void touch(const ui::TouchPicture& touch);
  void apply_set();
  void want_watch(bool on);
  void begin_watch();
  void act_alone(ui::TechnicianAct act);
  void keep_result();
  void record();
  bool is_calibrated();
  bool may_add_side() const;
  void say(const Error& error) { told_.problem = ui::fault_of(error); }
  void look_at_poses(const pipeline::Registration& registration);

  Parts parts_;
  EnrolmentSession& session_;
  TestShotJob shot_;
  RunJob run_;
  CameraWatchJob watch_;
  CalibrateJob calibrate_;
  CalibrationController calibrations_;
  RecordingController recording_;
  AlgorithmController algorithms_;
  TechnicianTables tables_;
  ui::StaffPage page_ = ui::StaffPage::Stages;  // opened last
  KeptResults kept_;
  ui::TechnicianView told_;  // phase, stage, problem, and what is switched on: shown as they are
  ui::TechnicianPoint point_;
  HandPairs pairs_;
  Next next_ = Next::None;
  std::uint32_t taking_ = 0, working_ = 0;  // the last side tasks of the capture thread and the worker
  struct Saved {
    SavedBytes bytes;
    std::string name;
    Making making;
    bool beside = false;  // what is there is put aside before
  };
  std::optional<Saved> saved_;  // read from the stick, to be loaded
  bool loaded_ = false;         // what is in the session was, with a calibration of its own
  bool watch_wanted_ = false;   // of the cameras, by whoever is on their page ...
  bool watching_ = false;       // ... and under way
  bool applying_ = false;       // the algorithms: visitors soon will be measured with them
  std::uint32_t visit_ = 0;     // what a technician asked for who has left is not told the next one
  bool left_ = true;            // for another state
  std::uint32_t model_number_ = 0;
  ui::TechnicianView view_;
};

}  // namespace relievo::firmware

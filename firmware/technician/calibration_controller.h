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

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "firmware/base/list_walk.h"
#include "firmware/records/event_log.h"
#include "firmware/service/side_tasks.h"
#include "firmware/technician/calibrate_job.h"
#include "firmware/work/pipeline_stages.h"
#include "storage/store.h"
#include "ui/technician/technician_view.h"
#include "ui/view/staff_request.h"

namespace relievo::firmware {

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

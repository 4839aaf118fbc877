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

#include <string>
#include <vector>

#include "firmware/service/side_tasks.h"
#include "firmware/technician/calibrate_job.h"
#include "firmware/work/pipeline_stages.h"
#include "storage/store.h"
#include "ui/view/staff_request.h"

namespace relievo::firmware {

class CalibrationController {
 public:
  struct Parts {
    CalibrateJob& job;
    PipelineStages& stages;  // replaced when another calibration comes into use
    storage::Store& store;
    SideTasks& side_tasks;
    hal::RemovableMedia& media;
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
  ui::TechnicianCalibration view();
  void forget();
  bool running() const { return running_; }

 private:
  void change_board(const ui::ChangeBoard& change);
  struct Row {
    storage::CalibrationInfo info;
    std::string made_at;
  };
  void store();
  void activate(std::size_t row);
  // By stick (calibration_stick.h).
  void export_in_use();
  void import_one();
  // Makes it the one in use, once the keeper has done `first`, which names it.
  void adopt(std::function<Result<std::uint32_t>()> first);

  Parts parts_;
  BoardArgs board_{10, 7, 20};
  bool running_ = false, ended_ = false, stored_ = false;
  ui::Fault problem_;
  std::string exported_;  // the folder on the stick
  std::vector<std::string> reasons_;
  std::vector<Row> history_;
  bool busy_ = false;  // the keeper is at it
};

}  // namespace relievo::firmware

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpticalCheckJob: the optical self-test from the first board to the last plate: calibrate, photograph
// every target, measure it. What comes out is judged by AcceptanceReport::lines().
// Errors: the rig's, calibration's and stages' own, with the target's name; Cancelled.
// Thread: made and read by main, run by the worker.
#pragma once

#include <atomic>
#include <string_view>

#include "firmware/checks/acceptance.h"
#include "firmware/jobs/job_thread.h"
#include "pipeline/calibrate/calibrator.h"

namespace relievo::firmware {

struct OpticalCheckOptions {
  std::uint32_t seed = 1;
  double scale = 1;  // of the pictures
  int boards = 14;
  std::vector<TargetPlace> dumbbells = dumbbell_places();
  std::vector<TargetPlace> plates = plate_places();
  OpticalTargets targets;
  ShowTarget show;  // empty: no pictures
};

// Every target of the options, with this calibration. `each` is called after every one.
Result<AcceptanceReport> measure_targets(const pipeline::StereoCalibration& calibration,
                                         const Photograph& photograph, const OpticalCheckOptions& options,
                                         const std::atomic<bool>& cancelled,
                                         const std::function<void()>& each);

class OpticalCheckJob final : public Job {
 public:
  OpticalCheckJob(Photograph photograph, OpticalCheckOptions options)
      : photograph_(std::move(photograph)), options_(std::move(options)) {}
  Result<void> run(JobControl& control) override;
  std::string_view stage() const { return measuring_.load() ? "Measure" : "Calibrate"; }  // any thread
  const pipeline::CalibratorOutput& calibration() const { return calibration_; }
  const AcceptanceReport& report() const { return report_; }

 private:
  Photograph photograph_;
  OpticalCheckOptions options_;
  std::atomic<bool> measuring_{false};
  pipeline::CalibratorOutput calibration_;
  AcceptanceReport report_;
};

}  // namespace relievo::firmware

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// DissertationJob: all of the dissertation's tables and figures. Figures 6 to 12 are done on the pair given;
// figure 17 too, where that is calibrated. What is left is done on a simulated person, whose truth is known.
// Thread: worker; now() any; result() once done. Errors: Cancelled; those of the virtual rig and of the disk;
// InvalidInput (no set could rectify the pair).
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string_view>

#include "firmware/arguments/command_line.h"
#include "firmware/compare/page/dissertation.h"
#include "firmware/compare/set_run.h"
#include "hal/base/result.h"
#include "pipeline/base/stage.h"
#include "pipeline/model/calibration.h"

namespace relievo::firmware::compare {

// Tables 1 and 2: a virtual rig of 20 units' baseline is calibrated from photographed boards; then the
// corners of a cube are matched by hand (clicks on whole pixels, half a pixel of tremble) and triangulated by
// linear least squares. Errors: the simulation's, the calibration's, the disk's. Thread: worker.
using Simulate = std::function<Result<void>(const SimulateArgs& args, const Path& folder)>;

struct VirtualRig {
  pipeline::StereoCalibration truth, found;
  double pair_rms_px = 0;
};

// Pictures and calibrations lie in `folder` afterwards.
Result<VirtualRig> calibrate_virtual_rig(const Simulate& simulate, const Path& folder);

RigTable rig_table(const VirtualRig& rig);
Result<CubeTable> cube_table(const VirtualRig& rig, pipeline::StageContext& context);

struct DissertationOrder {
  std::optional<ComparedPair> pair;
  std::vector<NamedSet> rule_sets, face_sets;  // suites.h
  bool whole_view = false;
  double limit_px = 1;
  Path work;  // a folder of its own, for simulated pictures
};

class DissertationJob final : public Job {
 public:
  DissertationJob(DissertationOrder order, Simulate simulate)
      : order_(std::move(order)), simulate_(std::move(simulate)) {}
  Result<void> run(JobControl& control) override;
  std::string_view now() const { return at_.load(std::memory_order_relaxed); }
  const Dissertation& result() const { return result_; }

 private:
  Result<void> make_tables(JobControl& control);
  Result<ComparedPair> simulated_person(JobControl& control);

  DissertationOrder order_;
  Simulate simulate_;
  Dissertation result_;
  std::atomic<const char*> at_{"tables 1 and 2"};
};

}  // namespace relievo::firmware::compare

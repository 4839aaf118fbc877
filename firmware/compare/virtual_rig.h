// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tables 1 and 2: a virtual rig of 20 units' baseline is calibrated from photographed boards; then the
// corners of a cube are matched by hand (clicks on whole pixels, half a pixel of tremble) and triangulated by
// linear least squares. Errors: the simulation's, the calibration's, the disk's. Thread: worker.
#pragma once

#include <functional>

#include "firmware/arguments/command_line.h"
#include "firmware/compare/page/dissertation.h"
#include "hal/base/result.h"
#include "pipeline/base/stage.h"
#include "pipeline/model/calibration.h"

namespace relievo::firmware::compare {

using Simulate = std::function<Result<void>(const SimulateArgs& args, const Path& folder)>;

struct VirtualRig {
  pipeline::StereoCalibration truth, found;
  double pair_rms_px = 0;
};

// Pictures and calibrations lie in `folder` afterwards.
Result<VirtualRig> calibrate_virtual_rig(const Simulate& simulate, const Path& folder);

RigTable rig_table(const VirtualRig& rig);
Result<CubeTable> cube_table(const VirtualRig& rig, pipeline::StageContext& context);

}  // namespace relievo::firmware::compare

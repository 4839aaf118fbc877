// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The calibration with which the targets are measured: made from photographed boards by the product's
// own finder and calibrator, never taken from the rig's truth.
// Errors: the rig's, the finder's and the calibrator's; PoorGeometry where its verdict is refuse;
// Cancelled. Thread: worker.
#pragma once

#include <functional>

#include "firmware/checks/optical_target.h"
#include "firmware/jobs/job_thread.h"
#include "pipeline/calibrate/calibrator.h"

namespace relievo::firmware {

// `each` is called after every board.
Result<pipeline::CalibratorOutput> calibrate_on_boards(const Photograph& photograph, const TargetShot& series,
                                                       int boards, const std::atomic<bool>& cancelled,
                                                       const std::function<void()>& each);

}  // namespace relievo::firmware

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// relievo calibrate --live --board sim|folder:DIR|linux:FILE --corners 10x7 --square-mm 20 -o rig.yml
//   [--goal-mm 0.1] [--baseline-mm N]
//
// A live calibration without a screen: one line a pair says what was decided and what to do next, then
// how many pairs a second it kept up with, then the verdict as calibrate gives it. A pair that cannot be
// used ends it. Nothing half-written stays; a calibration that is refused is not written.
// Errors: the board's, LiveCalibration's, calibrate()'s, PoorGeometry (refused). Thread: main.
#pragma once

#include <ostream>

#include "firmware/arguments/command_line.h"
#include "firmware/calibrate/calibrate_command.h"
#include "firmware/calibrate/calibrate_live_pairs.h"
#include "hal/base/result.h"
#include "pipeline/calibrate/calibrator.h"

namespace relievo::firmware {

Result<pipeline::CalibratorOutput> run_calibrate_live(const CalibrateLiveArgs& args, LivePairs& pairs,
                                                      std::ostream& out, const RigToday& today = {});

}  // namespace relievo::firmware

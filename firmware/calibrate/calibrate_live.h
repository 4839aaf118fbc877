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

#include <chrono>
#include <memory>
#include <optional>

#include "firmware/arguments/command_line.h"
#include "firmware/calibrate/calibrate_command.h"
#include "hal/base/image_view.h"
#include "hal/base/result.h"
#include "hal/device.h"
#include "pipeline/calibrate/calibrator.h"
#include "pipeline/calibrate/live/live_state.h"
#include "pipeline/model/calibration.h"

namespace relievo::firmware {

// Where a live calibration without a screen gets its pairs from: a board held before the simulated rig
// by a hand that follows the advice, or the cameras of a device (hal/device.h). Of a folder every pair is
// shown once, or, where no capture.json says that it is a recording, twice: a photograph is a board that
// is held still.
struct LivePair {
  ImageView left;  // until the next one is asked for
  ImageView right;
  std::chrono::nanoseconds at{0};
};

class LivePairs {
 public:
  virtual ~LivePairs() = default;
  // What the cameras see after the person has seen `state`. No value: there are no more.
  virtual Result<std::optional<LivePair>> next(const pipeline::LiveState& state) = 0;
  // Which cameras they are; empty before the first pair, and of cameras that say nothing of themselves.
  virtual pipeline::RigCameras cameras() const { return {}; }
};

// Errors: the folder's own (of "folder:DIR").
Result<std::unique_ptr<LivePairs>> make_device_pairs(std::unique_ptr<hal::Device> device,
                                                     std::string_view name);

Result<pipeline::CalibratorOutput> run_calibrate_live(const CalibrateLiveArgs& args, LivePairs& pairs,
                                                      const Tell& tell, const RigToday& today = {});

}  // namespace relievo::firmware

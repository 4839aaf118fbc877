// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a live calibration without a screen gets its pairs from: a board held before the simulated rig
// by a hand that follows the advice, or the cameras of a device (hal/device.h). Of a folder every pair is
// shown once, or, where no capture.json says that it is a recording, twice: a photograph is a board that
// is held still.
// Thread: main.
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "firmware/arguments/command_line.h"
#include "hal/base/image_view.h"
#include "hal/device.h"
#include "pipeline/calibrate/live/live_state.h"
#include "pipeline/model/calibration.h"

namespace relievo::firmware {

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

}  // namespace relievo::firmware

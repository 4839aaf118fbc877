// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StereoGrabber: one trigger pulse, one pair of pictures of the same instant.
//
//   pulse --> left.next_frame, right.next_frame --> the two exposures within kMaxSkew? --> slot
//                        ^                                  | no: the older one is dropped
//                        +----------------------------------+
//
// Errors: Timeout (no picture, or none that fits the other), Disconnected, InvalidInput (the views
// differ in size or do not fit the slot), Cancelled, and what the devices report. After an error
// the streams are restarted, so that no picture of a failed attempt is taken for a new one.
// Thread: capture.
#pragma once

#include <atomic>

#include "firmware/capture/stereo_slot.h"
#include "hal/camera.h"
#include "hal/clock.h"
#include "hal/trigger_line.h"
#include "pipeline/model/stereo_frame.h"

namespace relievo::firmware {

class StereoGrabber {
 public:
  StereoGrabber(hal::Camera& left, hal::Camera& right, hal::TriggerLine& trigger, const hal::Clock& clock)
      : left_(left), right_(right), trigger_(trigger), clock_(clock) {}
  ~StereoGrabber() { stop(); }
  StereoGrabber(const StereoGrabber&) = delete;
  StereoGrabber& operator=(const StereoGrabber&) = delete;

  // Opens the cameras where they are closed and starts the streams.
  Result<void> start(const hal::CaptureMode& mode);
  void stop();
  // The views of the result lie in the slot.
  Result<pipeline::StereoFrame> grab(StereoSlot& slot, const std::atomic<bool>& cancelled);

 private:
  Result<hal::Frame> next(hal::Camera& camera, hal::Instant deadline, const std::atomic<bool>& cancelled);
  Result<pipeline::StereoFrame> grab_once(StereoSlot& slot, const std::atomic<bool>& cancelled);
  Result<void> restart();

  hal::Camera& left_;
  hal::Camera& right_;
  hal::TriggerLine& trigger_;
  const hal::Clock& clock_;
};

}  // namespace relievo::firmware

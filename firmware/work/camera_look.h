// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CameraLook: takes one pair and forgets it, so that a camera that was unplugged is noticed while nobody
// stands before it, and one that was plugged in is opened and recognised (StereoGrabber::check_cameras()).
// Errors: StereoGrabber's. Thread: capture.
#pragma once

#include "firmware/capture/stereo_grabber.h"
#include "firmware/jobs/job_thread.h"
#include "firmware/session/session.h"

namespace relievo::firmware {

class CameraLook final : public Job {
 public:
  CameraLook(StereoGrabber& grabber, EnrolmentSession& session, const hal::CaptureMode& mode)
      : grabber_(grabber), session_(session), mode_(mode) {}
  // Once in kCameraReturn. Thread: main.
  bool due(hal::Instant now) {
    if (now < next_) return false;
    next_ = now + budget::kCameraReturn;
    return true;
  }
  Result<void> run(JobControl& control) override {
    RELIEVO_TRY(grabber_.start(mode_));
    StereoSlot& slot = session_.free_slot();
    const auto pair = grabber_.grab(slot, control.cancelled);
    slot.wipe();  // whoever passes by is in the pictures
    return pair ? Result<void>() : Result<void>(pair.error());
  }

 private:
  StereoGrabber& grabber_;
  EnrolmentSession& session_;
  hal::CaptureMode mode_;
  hal::Instant next_;
};

}  // namespace relievo::firmware

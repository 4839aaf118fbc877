// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TurnJob: follows the head that turns after the frontal picture, on the screen as in a mirror, and takes
// each side by itself when it is there and slow. It ends when every side is taken, when finish() says that is
// enough, when no new side has come for kTurnPatience, or where the head cannot be followed; the sides that
// are there are in the session. The light stays as it was set for the front. Works on one thread and in the
// session's follow_block(): the worker has the rest. Thread: run() capture, the others main. Errors: those of
// the grabber and of LiveJudge.
#pragma once

#include <atomic>

#include "firmware/work/jobs.h"

namespace relievo::firmware {

class TurnJob final : public Job {
 public:
  TurnJob(StereoGrabber& grabber, EnrolmentSession& session, hal::Device& device, PoseJob& pose,
          LiveJudge* judge)
      : grabber_(grabber),
        session_(session),
        device_(device),
        pose_(pose),
        judge_(judge),
        burst_(grabber, device.trigger(), device.clock()) {}
  // Before it starts: the frontal pair, which lies in the session.
  void begin_with(const pipeline::StereoFrame& front) {
    front_ = front;
    enough_ = false;
  }
  void finish() { enough_ = true; }
  Result<void> run(JobControl& control) override;

 private:
  Result<void> follow(JobControl& control, Arena& output, Arena& scratch);
  Result<void> take(const pipeline::StereoFrame& seen, JobControl& control);

  StereoGrabber& grabber_;
  EnrolmentSession& session_;
  hal::Device& device_;
  PoseJob& pose_;
  LiveJudge* judge_;
  Burst burst_;
  ThreadPool alone_{1};
  pipeline::StereoFrame front_;
  std::atomic<bool> enough_{false};
};

}  // namespace relievo::firmware

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The jobs of the three threads. Each is made once, with the appliance, and started many times.
//   capture: OpenCamerasJob, PoseJob, GrabJob    worker: StageJob    keeper: KeepJob, LookUpJob
#pragma once

#include <functional>

#include "firmware/capture/burst.h"
#include "firmware/capture/exposure_control.h"
#include "firmware/capture/live_judge.h"
#include "firmware/capture/stereo_grabber.h"
#include "firmware/jobs/job_thread.h"
#include "firmware/session/session.h"
#include "firmware/work/stage_runner.h"
#include "hal/base/thread_pool.h"
#include "hal/clock.h"
#include "hal/device.h"

namespace relievo::firmware {

// A camera that never answered is an error at once; one that was there and vanished is waited for.
class OpenCamerasJob final : public Job {
 public:
  OpenCamerasJob(StereoGrabber& grabber, const hal::CaptureMode& mode, const hal::Clock& clock)
      : grabber_(grabber), mode_(mode), clock_(clock) {}
  Result<void> run(JobControl& control) override;

 private:
  StereoGrabber& grabber_;
  hal::CaptureMode mode_;
  const hal::Clock& clock_;
};

// Pictures of the person for the screen, with advice, until it is cancelled. Kept are only the newest, small.
// Meanwhile both cameras are set to the light on the face.
class PoseJob final : public Job {
 public:
  PoseJob(StereoGrabber& grabber, EnrolmentSession& session, hal::Device& device, ThreadPool& pool,
          LiveJudge* judge)
      : grabber_(grabber),
        session_(session),
        device_(device),
        pool_(pool),
        judge_(judge),
        exposure_(device.left(), device.right()) {}
  Result<void> run(JobControl& control) override;
  // For the shot that follows on the same thread: where the face was last, and the exposure, to be locked.
  const std::optional<FaceBoxes>& face() const { return face_; }
  ExposureControl& exposure() { return exposure_; }

 private:
  Result<Guidance> judge(const pipeline::StereoFrame& frame, JobControl& control);
  Result<void> meter(const pipeline::StereoFrame& frame, Guidance& guidance);

  StereoGrabber& grabber_;
  EnrolmentSession& session_;
  hal::Device& device_;
  ThreadPool& pool_;
  LiveJudge* judge_;
  ExposureControl exposure_;
  FocusHelp focus_;
  std::optional<FaceBoxes> face_;
  int pairs_ = 0;
};

// Before a live device a burst at one exposure, else the next pair.
class GrabJob final : public Job {
 public:
  GrabJob(StereoGrabber& grabber, EnrolmentSession& session, hal::Device& device, PoseJob& pose)
      : grabber_(grabber),
        session_(session),
        device_(device),
        pose_(pose),
        burst_(grabber, device.trigger(), device.clock()) {}
  Result<void> run(JobControl& control) override;

 private:
  StereoGrabber& grabber_;
  EnrolmentSession& session_;
  hal::Device& device_;
  PoseJob& pose_;
  Burst burst_;
};

class StageJob final : public Job {
 public:
  StageJob(StageRunner& runner, EnrolmentSession& session, ThreadPool& pool, const hal::Clock& clock)
      : runner_(runner), session_(session), pool_(pool), clock_(clock) {}
  void choose(State stage) { stage_ = stage; }
  const StageRecord& record() const { return record_; }  // of the last run
  Result<void> run(JobControl& control) override;

 private:
  StageRunner& runner_;
  EnrolmentSession& session_;
  ThreadPool& pool_;
  const hal::Clock& clock_;
  State stage_ = State::Match;
  StageRecord record_;
};

// Puts a finished model away; how, the appliance's maker says (a store, or a test's memory).
using Keep = std::function<Result<void>(std::string_view subject, const pipeline::FaceModel& model)>;

class KeepJob final : public Job {
 public:
  KeepJob(Keep keep, EnrolmentSession& session) : keep_(std::move(keep)), session_(session) {}
  Result<void> run(JobControl& control) override;

 private:
  Keep keep_;
  EnrolmentSession& session_;
};

// Asks the records while nobody's session is open.
class LookUpJob final : public Job {
 public:
  explicit LookUpJob(std::function<Result<void>()> look_up) : look_up_(std::move(look_up)) {}
  Result<void> run(JobControl&) override { return look_up_(); }

 private:
  std::function<Result<void>()> look_up_;
};

}  // namespace relievo::firmware

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/work/jobs.h"

#include <thread>

#include "firmware/work/stage_picture.h"
#include "hal/base/assert.h"

namespace relievo::firmware {

Result<void> OpenCamerasJob::run(JobControl& control) {
  const hal::Instant until = clock_.now() + budget::kCameraReturn;
  for (;;) {
    Result<void> started = grabber_.start(mode_);
    if (started || grabber_.watch() == CameraWatch::Well || clock_.now() >= until) return started;
    if (control.cancelled.load()) return Error{Errc::Cancelled, "the cameras are no longer waited for"};
    std::this_thread::sleep_for(budget::kTick / 2);
  }
}

Result<void> PoseJob::run(JobControl& control) {
  RELIEVO_TRY(grabber_.start(mode_));
  if (guide_ != nullptr) guide_->begin();
  while (!control.cancelled.load(std::memory_order_relaxed)) {
    RELIEVO_TRY_ASSIGN(const pipeline::StereoFrame frame, grabber_.grab(session_.slot(), control.cancelled));
    LiveFeed& live = session_.live();
    const ImageView small = live.fill(frame.left);
    Guidance guidance;
    if (guide_ != nullptr) {
      RELIEVO_TRY_ASSIGN(guidance, guide_->look(small, frame.left.width_px, clock_.now(), &control.cancelled));
    }
    live.publish(guidance);
    std::this_thread::sleep_for(budget::kLivePause);
  }
  return Error{Errc::Cancelled, "nobody looks at the live picture any more"};
}

Result<void> GrabJob::run(JobControl& control) {
  RELIEVO_TRY(grabber_.start(board_.preferred_mode()));  // nothing where the streams run already
  BurstOptions options;
  options.light = board_.shot_light();
  if (!board_.is_live()) {
    RELIEVO_TRY_ASSIGN(session_.products().frame, grabber_.grab(session_.slot(), control.cancelled));
    return {};
  }
  RELIEVO_TRY_ASSIGN(const BurstResult burst, burst_.shoot(session_.slot(), session_.spare_slot(), options, control.cancelled));
  session_.products().frame = burst.frame;
  return {};
}

Result<void> StageJob::run(JobControl& control) {
  record_ = {};
  record_.name = name_of(stage_);
  Arena& output = session_.output();
  EnrolmentSession::Scratch scratch(session_);
  pipeline::StageContext context{output, scratch.arena(), pool_, control.progress, control.cancelled};
  const hal::Instant begin = clock_.now();
  const Result<void> result = runner_.run(stage_, session_.products(), context, record_);
  record_.took = clock_.now() - begin;
  if (result) draw_stage_picture(stage_, session_.products(), session_.stage_pictures());
  record_.arena_peak_bytes = output.used() + scratch.arena().high_water();
  return result;
}

Result<void> KeepJob::run(JobControl& control) {
  // Asked before the transaction begins: once it runs, it ends, whole or not at all.
  if (control.cancelled.load()) return Error{Errc::Cancelled, "nothing was stored"};
  RELIEVO_ASSERT(session_.products().model.has_value());
  return keep_(session_.subject(), *session_.products().model);
}

}  // namespace relievo::firmware

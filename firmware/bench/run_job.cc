// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/bench/run_job.h"

#include "firmware/work/pipeline_stages.h"

namespace relievo::firmware {

void RunJob::order(const pipeline::AlgorithmSet& set, const pipeline::StereoCalibration& calibration) {
  set_ = set;
  calibration_ = calibration;
  now_.store(State::Match, std::memory_order_relaxed);
}

Result<void> RunJob::run(JobControl& control) {
  outcome_ = Error{Errc::LibraryFailed, "the stages ended early"};  // what a library's exception leaves
  return outcome_ = work(control);
}

Result<void> RunJob::work(JobControl& control) {
  session_.rework();
  pictures_.wipe();
  figures_.begin(set_);
  RELIEVO_TRY_ASSIGN(auto pipeline, pipeline::Pipeline::make(set_, calibration_));
  PipelineStages stages(std::move(pipeline), WhenMoved::GoOn, WhenUnjudged::GoOn);
  StageJob job(stages, session_, pool_, clock_);
  for (const State stage : {State::Match, State::Reconstruct, State::Mesh, State::Texture}) {
    now_.store(stage, std::memory_order_relaxed);
    job.choose(stage);
    const Result<void> done = job.run(control);
    if (!done && done.error().code == Errc::Cancelled) return done;
    figures_.add(job.record());
    if (done) continue;
    figures_.fail(stage, done.error());
    break;
  }
  if (session_.products().model && session_.products().model->unjudged) figures_.fail(State::Texture, *session_.products().model->unjudged);
  return finish(control);
}

Result<void> RunJob::finish(JobControl& control) {
  EnrolmentSession::Scratch scratch(session_);
  pipeline::StageContext context{session_.output(), scratch.arena(), pool_, control.progress, control.cancelled};
  RELIEVO_TRY(figures_.measure(session_.products(), context));
  pictures_.draw(session_.products());
  return {};
}

}  // namespace relievo::firmware

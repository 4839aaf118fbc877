// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/command/reconstruct/reconstruction.h"

#include "firmware/command/line/algorithm_choice.h"
#include "firmware/command/reconstruct/picture_pair.h"
#include "firmware/command/watched_job.h"
#include "firmware/work/pool_size.h"
#include "firmware/work/reconstruct_job.h"
#include "hal/monotonic_clock.h"
#include "pipeline/recognition/recognition_images.h"

namespace relievo::firmware {

Result<void> Reconstruction::run(const Path& left, const Path& right, const Path& calibration_file,
                                 const AlgorithmArgs& algorithms, Console& console, WhenMoved when_moved) {
  RELIEVO_TRY_ASSIGN(const PicturePair pictures, read_pair(left, right));
  RELIEVO_TRY_ASSIGN(const auto calibration, read_calibration_for(pictures, calibration_file, left));
  RELIEVO_TRY_ASSIGN(auto pipeline, make_pipeline(algorithms, calibration));

  ThreadPool pool(pool_size());
  const hal::MonotonicClock clock;
  PipelineStages stages(std::move(pipeline), when_moved, WhenUnjudged::GoOn);
  ReconstructJob job(stages, session_, pool, clock);
  RELIEVO_TRY(session_.open(""));
  session_.products().frame = pictures.frame();
  const Result<void> done = run_watched(job, console, [&job] { return name_of(job.stage()); });
  session_.products().frame.reset();  // the pictures go with this function
  if (!done && done.error().code == Errc::Cancelled) return Error{Errc::Cancelled, "cancelled: nothing was written"};
  // A stage does not know the names of the files it works on.
  if (!done) return done.error().at(left.string() + (done.error().where().empty() ? "" : ": " + std::string(done.error().where())));
  report_ = {calibration_file.string(), stages.algorithms().to_text(), job.records(), job.took(),
             peak_rss_bytes(), model().quality, session_.products().drift,
             session_.products().matches->motion_px, model().landmarks, model().head_from_camera,
             pipeline::measure_overexposure(*session_.products().pair, *session_.products().matches)};
  return {};
}

Result<pipeline::RecognitionImages> Reconstruction::draw_images() {
  EnrolmentSession::Scratch scratch(session_);
  return pipeline::make_recognition_images(model(), session_.output(), scratch.arena());
}

}  // namespace relievo::firmware

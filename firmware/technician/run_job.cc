// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/technician_jobs.h"

#include <algorithm>

#include "hal/raw/raw_image.h"

namespace relievo::firmware {

void RunJob::order(const pipeline::AlgorithmSet& set, const pipeline::StereoCalibration& calibration,
                   State first, std::vector<pipeline::Match> by_hand, bool whole_view) {
  before_ = making_;
  making_.set = set;
  making_.calibration = calibration;
  making_.whole_view = whole_view;
  making_.by_hand = std::move(by_hand);
  if (wants_before()) first = std::min(first, State::Reconstruct);
  making_.records.resize(std::min(making_.records.size(), number_of(first)));
  first_ = static_cast<State>(std::size_t(State::Match) + making_.records.size());
  document_.reset();
  now_.store(first_, std::memory_order_relaxed);
}

void RunJob::order(SavedBytes document, Making making) {
  before_ = making_;
  document_ = std::move(document);
  making_ = std::move(making);
  now_.store(State::Match, std::memory_order_relaxed);
}

bool RunJob::take_back() {
  if (!before_) return false;
  document_.reset();
  making_ = *std::exchange(before_, std::nullopt);
  return true;
}

Making RunJob::making_with(std::vector<pipeline::Match> by_hand) const {
  Making making = making_;
  const bool the_same =
      std::ranges::equal(by_hand, making_.by_hand, [](const pipeline::Match& a, const pipeline::Match& b) {
        return a.left_px.x == b.left_px.x && a.left_px.y == b.left_px.y && a.disparity_px == b.disparity_px &&
               a.sigma_px == b.sigma_px;
      });
  if (the_same || !session_.products().pair) return making;
  making.by_hand = std::move(by_hand);
  making.records.resize(std::min(making.records.size(), number_of(State::Reconstruct)));
  return making;
}

Result<void> RunJob::run(JobControl& control) {
  before_.reset();
  pictures_.wipe();
  figures_.begin(making_.set, name_);
  if (document_) return load(control);
  if (first_ <= kStages.back()) session_.rework(first_);
  for (const StageRecord& record : making_.records) figures_.add(record);
  RELIEVO_TRY_ASSIGN(auto pipeline, pipeline::Pipeline::make(
                                        making_.set, making_.calibration, {},
                                        making_.whole_view ? pipeline::Region::All : pipeline::Region::Face));
  PipelineStages stages(std::move(pipeline), WhenMoved::GoOn, WhenUnjudged::GoOn);
  stages.add_by_hand(making_.by_hand);
  StageJob job(stages, session_, pool_, clock_);
  for (const State stage : kStages) {
    if (stage < first_) continue;
    if (stage == State::Reconstruct && wants_before()) {
      RELIEVO_TRY(before_pairs(stages, job, control));
    }
    now_.store(stage, std::memory_order_relaxed);
    job.choose(stage);
    const Result<void> done = job.run(control);
    if (!done && done.error().code == Errc::Cancelled) return done;
    figures_.add(job.record());
    if (done) {
      making_.records.push_back(job.record());
      continue;
    }
    figures_.fail(stage, done.error());
    break;
  }
  std::vector<pipeline::HeadPose> poses;
  if (session_.products().model && session_.sides().count() > 0) {
    RELIEVO_TRY(add_sides(stages, control, poses));
  }
  return finish(control, poses);
}

Result<void> RunJob::add_sides(PipelineStages& stages, JobControl& control,
                               std::vector<pipeline::HeadPose>& poses) {
  now_.store(State::Assemble, std::memory_order_relaxed);
  session_.sides().end();
  HeadJob head(stages, session_, pool_, clock_);
  const Result<void> done = head.add_sides(control, poses);
  session_.sides().begin();  // each pair's room has become its pose's
  if (head.lost()) figures_.fail(State::Assemble, *head.lost());
  return done;
}

Result<void> TestShotJob::take_side(JobControl& control) {
  RELIEVO_TRY(grabber_.start(device_.preferred_mode()));
  RELIEVO_TRY(grabber_.check_cameras());
  RELIEVO_TRY_ASSIGN(const pipeline::StereoFrame frame,
                     grabber_.grab(session_.free_slot(), control.cancelled));
  return turn_.take(frame, control);
}

Result<void> RunJob::before_pairs(PipelineStages& stages, StageJob& job, JobControl& control) {
  stages.add_by_hand({});
  for (const State stage : {State::Reconstruct, State::Mesh}) {
    now_.store(stage, std::memory_order_relaxed);
    job.choose(stage);
    const Result<void> done = job.run(control);
    if (!done && done.error().code == Errc::Cancelled) return done;
    if (!done) break;  // without the pairs there is no surface
  }
  if (const Products& made = session_.products(); made.mesh)
    change_.before(making_.set, *made.pair, *made.mesh);
  session_.rework(State::Reconstruct);
  stages.add_by_hand(making_.by_hand);
  return {};
}

Result<void> RunJob::load(JobControl& control) {
  const SavedBytes bytes = *std::exchange(document_, std::nullopt);
  change_.forget();                                                       // another capture
  std::vector<StageRecord> records = std::exchange(making_.records, {});  // none is done before all are read
  RELIEVO_TRY_ASSIGN(const storage::Document document, storage::Document::open(bytes));
  pipeline::StereoFrame frame;
  frame.skew_ns = document.head().skew_ns;
  for (const bool left : {true, false}) {
    RELIEVO_TRY_ASSIGN(const storage::Document::Picture picture, document.picture(left));
    const hal::RawImage raw = hal::raw_of(picture.view);
    const Result<ImageView> kept = left ? session_.slot().keep_left(raw) : session_.slot().keep_right(raw);
    if (!kept) return kept.error();
    (left ? frame.left : frame.right) = *kept;
  }
  session_.took(frame);
  RELIEVO_TRY_ASSIGN(const State left_to_do, load_products(document, State::Review, session_, control));
  making_.records = std::move(records);
  for (const StageRecord& record : making_.records) figures_.add(record);
  if (left_to_do != State::Review)
    figures_.fail(left_to_do,
                  {Errc::NotFound, "this stage had not been done when it was saved: calculate again"});
  return finish(control, {});
}

Result<void> RunJob::finish(JobControl& control, std::span<const pipeline::HeadPose> poses) {
  if (session_.products().model && session_.products().model->unjudged)
    figures_.fail(State::Assemble, *session_.products().model->unjudged);
  EnrolmentSession::Scratch scratch(session_);
  pipeline::StageContext context{session_.output(), scratch.arena(), pool_, control.progress,
                                 control.cancelled};
  RELIEVO_TRY(figures_.measure(session_.products(), context));
  // A head is no surface of the capture alone.
  if (session_.products().registration) change_.forget();
  else change_.measure(making_, session_.products());
  pictures_.draw(session_.products(), change_);
  pictures_.draw_poses(session_.products(), poses);
  return {};
}

}  // namespace relievo::firmware

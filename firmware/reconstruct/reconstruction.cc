// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/reconstruct/reconstruction.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "firmware/arguments/algorithm_choice.h"
#include "firmware/jobs/job_thread.h"
#include "firmware/reconstruct/picture_pair.h"
#include "firmware/work/jobs.h"
#include "firmware/work/session_document.h"
#include "hal/base/whole_file.h"
#include "hal/monotonic_clock.h"
#include "pipeline/match/file/match_text.h"
#include "pipeline/match/rectify/rectifier.h"
#include "pipeline/recognition/recognition_images.h"

namespace relievo::firmware {
namespace {

// ReconstructJob: all stages in a row, or the last of them, on a frame that lies in the session already.
// What the machine does state by state, as one job for commands that have no machine. Errors: those of the
// stage that failed. Thread: worker; stage() and records() any, records() once done.

class ReconstructJob final : public Job {
 public:
  // The stages before `first` are done, their products in the session.
  ReconstructJob(StageRunner& runner, EnrolmentSession& session, ThreadPool& pool, State first)
      : first_(first), stage_(runner, session, pool, clock_) {}

  State stage() const { return now_.load(std::memory_order_relaxed); }  // the one that runs, or ran last
  const std::vector<StageRecord>& records() const { return records_; }
  std::chrono::nanoseconds took() const { return took_; }
  Result<void> run(JobControl& control) override {
    const hal::Instant begin = clock_.now();
    for (const State stage : kStages) {
      if (stage < first_) continue;
      now_.store(stage, std::memory_order_relaxed);
      stage_.choose(stage);
      RELIEVO_TRY(stage_.run(control));
      records_.push_back(stage_.record());
    }
    took_ = clock_.now() - begin;
    return {};
  }

 private:
  const hal::MonotonicClock clock_;
  const State first_;
  StageJob stage_;
  std::atomic<State> now_{State::Match};
  std::vector<StageRecord> records_;
  std::chrono::nanoseconds took_{0};
};

constexpr std::size_t kMostByHandBytes = std::size_t{64} << 20;

// The file, and at what in it.
Error placed(const Error& error, const Path& file) {
  return error.at(file.string() + (error.where().empty() ? "" : ": " + std::string(error.where())));
}

void describe(const pipeline::AlgorithmSet& set, const pipeline::FaceModel& model, Report& report) {
  report.algorithms = set.to_text();
  report.peak_rss_bytes = peak_rss_bytes();
  report.quality = model.quality;
  report.landmarks = model.landmarks;
  report.head_from_camera = model.head_from_camera;
}

// The words of --from.
State stage_named(std::string_view word) {
  if (word == "match") return State::Match;
  if (word == "reconstruct") return State::Reconstruct;
  if (word == "mesh") return State::Mesh;
  return word == "texture" ? State::Texture : State::Assemble;
}

Result<State> first_stage(std::string_view from, State changed) {
  if (from.empty()) return changed;
  const State named = stage_named(from);
  if (changed >= named) return named;
  return Error{Errc::InvalidInput,
               "a setting changes a stage before this one: begin there, or leave --from out"}
      .at("--from " + std::string(from));
}

Result<std::vector<pipeline::Match>> read_by_hand(const Path& file,
                                                  const pipeline::StereoCalibration& calibration) {
  pipeline::RectifiedPair windows(std::pmr::get_default_resource());
  RELIEVO_TRY(pipeline::lay_windows(calibration, {}, windows));
  RELIEVO_TRY_ASSIGN(const auto bytes, read_whole_file(file, kMostByHandBytes));
  RELIEVO_TRY_ASSIGN(
      const auto matches,
      pipeline::matches_in({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string(),
                           windows, pipeline::kHandSigmaPx, std::pmr::get_default_resource()));
  return std::vector<pipeline::Match>(matches.begin(), matches.end());
}

static_assert(kMostPairs == pipeline::kMostPoses);

struct Shot {
  PicturePair pictures;
  pipeline::StereoCalibration calibration;
  Path left;
};

PoseReport report_of(const pipeline::RegisteredPose& pose) {
  PoseReport report;
  report.first_from_pose = pose.first_from_pose;
  report.turned_deg = pipeline::turned_deg(pose.first_from_pose.rotation);
  report.rms_mm = pose.rms_mm;
  report.joined = pose.joined;
  const auto worst = [&](std::size_t from) {
    return std::sqrt(std::max(
        {pose.covariance[7 * from], pose.covariance[7 * (from + 1)], pose.covariance[7 * (from + 2)]}));
  };
  report.sigma_deg = worst(0) * 180 / std::numbers::pi;
  report.sigma_mm = worst(3);
  return report;
}

}  // namespace

Result<void> Reconstruction::run(const Path& left, const Path& right, const Path& calibration_file,
                                 const AlgorithmArgs& algorithms, const Path& by_hand, Console& console,
                                 WhenMoved when_moved) {
  RELIEVO_TRY_ASSIGN(PicturePair pictures, read_pair(left, right));
  RELIEVO_TRY_ASSIGN(making_.calibration, read_calibration_for(pictures, calibration_file, left));
  RELIEVO_TRY_ASSIGN(making_.set, choose_algorithms(algorithms));
  making_.whole_view = algorithms.whole_view;
  if (!by_hand.empty()) {
    RELIEVO_TRY_ASSIGN(making_.by_hand, read_by_hand(by_hand, making_.calibration));
  }
  RELIEVO_TRY(session_.open(""));
  session_.products().frame = pictures.frame();
  left_ = std::move(pictures.left.bytes);  // what the frame looks at stays where it is
  right_ = std::move(pictures.right.bytes);
  RELIEVO_TRY(work(State::Match, console, left, when_moved));
  report_.calibration = calibration_file.string();
  return {};
}

Result<void> Reconstruction::load(const Path& document, std::string_view from,
                                  const AlgorithmArgs& algorithms, const Path& by_hand, Console& console,
                                  WhenMoved when_moved) {
  const auto of_document = [&document](const Error& error) {
    return error.where().empty() ? error.at(document.string()) : error;
  };
  RELIEVO_TRY_ASSIGN(const std::vector<std::byte> bytes,
                     read_whole_file(document, storage::kMaxDocumentBytes));
  const auto saved = storage::Document::open(bytes);
  if (!saved) return of_document(saved.error());
  RELIEVO_TRY_ASSIGN(making_, making_of(*saved));
  RELIEVO_TRY_ASSIGN(const pipeline::AlgorithmSet wanted, choose_algorithms(algorithms, making_.set));
  State changed = first_change(making_.set, wanted);
  if (!by_hand.empty()) {
    RELIEVO_TRY_ASSIGN(making_.by_hand, read_by_hand(by_hand, making_.calibration));
    changed = std::min(changed, State::Reconstruct);
  }
  RELIEVO_TRY_ASSIGN(const State first, first_stage(from, changed));
  making_.set = wanted;
  RELIEVO_TRY(session_.open(""));
  pipeline::StereoFrame frame;
  frame.skew_ns = saved->head().skew_ns;
  for (const bool left : {true, false}) {
    auto picture = saved->picture(left);
    if (!picture) return of_document(picture.error());
    (left ? left_ : right_) = std::move(picture->bytes);
    (left ? frame.left : frame.right) = picture->view;
  }
  session_.products().frame = frame;
  const std::atomic<bool> never{false};
  pipeline::Progress progress;
  JobControl control{never, progress};
  const Result<State> left_to_do = load_products(*saved, first, session_, control);
  if (!left_to_do) return of_document(left_to_do.error());
  RELIEVO_TRY(work(*left_to_do, console, document, when_moved));
  report_.calibration = document.string();
  return {};
}

// What is done already is in the session, and its records in the making.
Result<void> Reconstruction::work(State first, Console& console, const Path& named, WhenMoved when_moved) {
  first_ = first;
  making_.records.resize(std::min(making_.records.size(), std::size_t(first) - std::size_t(State::Match)));
  if (first != State::Review) {
    RELIEVO_TRY_ASSIGN(auto pipeline, pipeline::Pipeline::make(making_.set, making_.calibration, {},
                                                               making_.whole_view ? pipeline::Region::All
                                                                                  : pipeline::Region::Face));
    ThreadPool pool(pool_size());
    PipelineStages stages(std::move(pipeline), when_moved, WhenUnjudged::GoOn);
    stages.add_by_hand(making_.by_hand);
    ReconstructJob job(stages, session_, pool, first);
    const Result<void> done = run_watched(job, console, [&job] { return name_of(job.stage()); });
    // A stage does not know the names of the files it works on.
    if (!done) return done.error().code == Errc::Cancelled ? done.error() : placed(done.error(), named);
    making_.records.insert(making_.records.end(), job.records().begin(), job.records().end());
    report_.total = job.took();
  }
  const Products& made = session_.products();
  describe(making_.set, model(), report_);
  report_.stages = making_.records;
  report_.by_hand = making_.by_hand.size();
  report_.drift = made.drift;
  report_.motion_px = made.matches->motion_px;
  report_.white = pipeline::measure_overexposure(*made.pair, *made.matches);
  return {};
}

Result<void> Reconstruction::save(const Path& document) const {
  RELIEVO_TRY_ASSIGN(const std::vector<std::byte> bytes, make_document(session_.products(), making_));
  return write_whole_file(document, bytes);
}

Result<pipeline::RecognitionImages> Reconstruction::draw_images() {
  EnrolmentSession::Scratch scratch(session_);
  return pipeline::make_recognition_images(model(), session_.output(), scratch.arena());
}

class HeadReconstruction::PairsJob final : public Job {
 public:
  PairsJob(const pipeline::HeadPipeline& pipeline, const std::vector<Shot>& shots, HeadReconstruction& owner,
           ThreadPool& pool, WhenMoved when_moved)
      : pipeline_(pipeline),
        shots_(shots),
        owner_(owner),
        pool_(pool),
        when_moved_(when_moved),
        scratch_(owner.memory_.scratch()) {}

  // Which pair is worked on; as many as there are: all of them together. Thread: any.
  std::size_t at() const { return at_.load(std::memory_order_relaxed); }

  Result<void> run(JobControl& control) override;

 private:
  template <typename Work>
  auto timed(std::string_view name, std::size_t pair, Work&& work) {
    at_.store(pair, std::memory_order_relaxed);
    const hal::MonotonicClock clock;
    const hal::Instant begin = clock.now();
    scratch_.wipe();
    auto done = work();
    StageRecord record;
    record.name = name;
    record.took = clock.now() - begin;
    record.in = pair == shots_.size() ? pair : pair + 1;
    record.arena_peak_bytes = scratch_.high_water();
    owner_.report_.stages.push_back(record);
    owner_.report_.total += record.took;
    return done;
  }

  bool refused(const pipeline::DriftJudgement& drift) const {
    return drift.verdict == pipeline::DriftVerdict::Refuse && when_moved_ == WhenMoved::Refuse;
  }
  const pipeline::HeadPipeline& pipeline_;
  const std::vector<Shot>& shots_;
  HeadReconstruction& owner_;
  ThreadPool& pool_;
  WhenMoved when_moved_;
  Arena scratch_;
  std::atomic<std::size_t> at_{0};
};

Result<void> HeadReconstruction::PairsJob::run(JobControl& control) {
  pipeline::StageContext context{owner_.output_, scratch_, pool_, control.progress, control.cancelled};
  std::vector<pipeline::HeadPose> poses;
  poses.reserve(shots_.size());
  std::optional<pipeline::FaceModel> face;
  for (std::size_t k = 0; k < shots_.size(); ++k) {
    if (k == 1) {  // the first pair fits its calibration
      auto made = timed("Face", 0, [&] {
        return pipeline_.face(shots_[0].pictures.frame(), shots_[0].calibration, context);
      });
      if (!made) return placed(made.error(), shots_[0].left);
      face.emplace(*std::move(made));
    }
    const Arena::Mark mark(owner_.output_);
    const auto added = timed("Pair", k, [&]() -> Result<void> {
      RELIEVO_TRY_ASSIGN(
          pipeline::HeadPose pose,
          pipeline_.measure(shots_[k].pictures.frame(), shots_[k].calibration, context, *owner_.kept_));
      if (k == 0) owner_.report_.drift = pose.drift;
      if (refused(pose.drift)) return error_of(pose.drift);
      poses.push_back(std::move(pose));
      return k == 0 ? Result<void>() : pipeline_.place_last(*face, poses, context);
    });
    if (!added) return placed(added.error(), shots_[k].left);
  }
  auto head = timed("Fuse", shots_.size(), [&] { return pipeline_.fuse(*face, poses, context); });
  if (!head) return head.error();
  owner_.head_.emplace(*std::move(head));
  return {};
}

Result<void> HeadReconstruction::run(const std::vector<Path>& pictures, const std::vector<Path>& calibrations,
                                     const AlgorithmArgs& algorithms, Console& console,
                                     WhenMoved when_moved) {
  RELIEVO_TRY_ASSIGN(const pipeline::AlgorithmSet set, choose_algorithms(algorithms));
  RELIEVO_TRY_ASSIGN(const auto pipeline, pipeline::HeadPipeline::make(set));
  std::vector<Shot> shots(pictures.size() / 2);
  for (std::size_t k = 0; k < shots.size(); ++k) {
    shots[k].left = pictures[2 * k];
    RELIEVO_TRY_ASSIGN(shots[k].pictures, read_pair(pictures[2 * k], pictures[2 * k + 1]));
    const Path& file = calibrations[calibrations.size() == 1 ? 0 : k];
    RELIEVO_TRY_ASSIGN(shots[k].calibration, read_calibration_for(shots[k].pictures, file, shots[k].left));
  }
  const std::size_t kept = shots.size() * budget::pose_bytes(budget::kMostFramePixels);
  kept_block_ = PageBlock(kept);
  kept_.emplace(kept_block_.bytes());
  ThreadPool pool(pool_size());
  PairsJob job(pipeline, shots, *this, pool, when_moved);
  const Result<void> done =
      run_watched(job, console, [&] { return std::string_view(job.at() == shots.size() ? "Fuse" : "Pair"); });
  if (!done) return done.error();
  report_.calibration = calibrations.front().string();
  describe(set, model(), report_);
  report_.aliveness = head_->aliveness;
  report_.skin_moved_mm = head_->registration.skin_moved_mm;
  const auto& poses = head_->registration.poses;
  for (const auto& pose : poses) {
    report_.poses.push_back(report_of(pose));
    report_.poses.back().meets.assign(pose.meets.begin(), pose.meets.begin() + std::ptrdiff_t(poses.size()));
  }
  return {};
}

Result<pipeline::RecognitionImages> HeadReconstruction::draw_images() {
  Arena scratch(memory_.scratch());
  return pipeline::make_recognition_images(model(), output_, scratch);
}

}  // namespace relievo::firmware

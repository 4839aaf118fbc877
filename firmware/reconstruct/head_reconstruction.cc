// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/reconstruct/head_reconstruction.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <utility>

#include "firmware/arguments/algorithm_choice.h"
#include "firmware/jobs/job_thread.h"
#include "firmware/jobs/watched_job.h"
#include "firmware/reconstruct/picture_pair.h"
#include "hal/monotonic_clock.h"
#include "pipeline/recognition/recognition_images.h"

namespace relievo::firmware {
namespace {

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
  Error placed(const Error& error, std::size_t pair) const {
    const std::string where = error.where().empty() ? "" : ": " + std::string(error.where());
    return error.at(shots_[pair].left.string() + where);
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
  for (std::size_t k = 0; k < shots_.size(); ++k) poses.emplace_back(&*owner_.kept_);
  for (std::size_t k = 0; k < shots_.size(); ++k) {
    const Arena::Mark mark(owner_.output_);
    auto pose = timed("Pair", k, [&] {
      return pipeline_.measure(shots_[k].pictures.frame(), shots_[k].calibration, context, *owner_.kept_);
    });
    if (!pose) return placed(pose.error(), k);
    poses[k] = *std::move(pose);
    if (k == 0) owner_.report_.drift = poses[k].drift;
    if (refused(poses[k].drift)) return placed(error_of(poses[k].drift), k);
  }
  auto face = timed(
      "Face", 0, [&] { return pipeline_.face(shots_[0].pictures.frame(), shots_[0].calibration, context); });
  if (!face) return placed(face.error(), 0);
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
  const std::size_t kept = shots.size() * budget::kPoseBytes;
  kept_block_ = PageBlock(kept);
  kept_.emplace(kept_block_.bytes());
  ThreadPool pool(pool_size());
  PairsJob job(pipeline, shots, *this, pool, when_moved);
  const Result<void> done =
      run_watched(job, console, [&] { return std::string_view(job.at() == shots.size() ? "Fuse" : "Pair"); });
  if (!done && done.error().code == Errc::Cancelled)
    return Error{Errc::Cancelled, "cancelled: nothing was written"};
  if (!done) return done.error();
  report_.calibration = calibrations.front().string();
  report_.algorithms = set.to_text();
  report_.peak_rss_bytes = peak_rss_bytes();
  report_.quality = model().quality;
  report_.landmarks = model().landmarks;
  report_.head_from_camera = model().head_from_camera;
  report_.aliveness = head_->aliveness;
  report_.skin_moved_mm = head_->registration.skin_moved_mm;
  const auto& poses = head_->registration.poses;
  for (const auto& pose : poses) {
    report_.poses.push_back(report_of(pose));
    report_.poses.back().meets.assign(pose.meets.begin(),
                                      pose.meets.begin() + static_cast<std::ptrdiff_t>(poses.size()));
  }
  return {};
}

Result<pipeline::RecognitionImages> HeadReconstruction::draw_images() {
  Arena scratch(memory_.scratch());
  return pipeline::make_recognition_images(model(), output_, scratch);
}

}  // namespace relievo::firmware

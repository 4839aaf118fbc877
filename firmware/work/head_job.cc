// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/work/head_job.h"

#include <utility>

#include "firmware/work/portrait_progress.h"

namespace relievo::firmware {

Result<void> HeadJob::run(JobControl& control) {
  records_.clear();
  parts_done_ = 0;
  for (const State stage : kStages) {
    JobControl inner{control.cancelled, inner_};
    stage_.choose(stage);
    RELIEVO_TRY(stage_.run(inner));
    records_.push_back(stage_.record());
    parts_done_.fetch_add(1, std::memory_order_release);
  }
  int lost = 0;
  std::vector<pipeline::HeadPose> poses;
  poses.reserve(SidePairs::kPoses);
  while (const auto side = session_.sides().next(control.cancelled)) {
    // What is wrong with a pair here spoils no face.
    if (poses.empty() && !measure(*session_.products().frame, control, poses)) continue;
    if (!measure(*side, control, poses)) ++lost;
    parts_done_.fetch_add(1, std::memory_order_release);
  }
  parts_done_.store(PortraitProgress::kFuse, std::memory_order_release);
  if (poses.size() > 1 && !fuse(control, poses)) lost += static_cast<int>(poses.size()) - 1;
  if (session_.products().model) session_.products().model->poses_left_out += lost;
  if (control.cancelled.load()) return Error{Errc::Cancelled, "stopped while the head was made"};
  return {};
}

template <typename Work>
auto HeadJob::timed(std::string_view name, JobControl& control, Work&& work) {
  EnrolmentSession::Scratch scratch(session_);
  pipeline::StageContext context{session_.output(), scratch.arena(), pool_, inner_, control.cancelled};
  StageRecord record;
  record.name = name;
  const hal::Instant begin = clock_.now();
  auto done = pipeline::run_stage(context, [&](pipeline::StageContext& c) { return work(c, record); });
  record.took = clock_.now() - begin;
  record.arena_peak_bytes = session_.output().used() + scratch.arena().high_water();
  if (done) records_.push_back(record);
  return done;
}

Result<void> HeadJob::measure(const pipeline::StereoFrame& pair, JobControl& control,
                              std::vector<pipeline::HeadPose>& poses) {
  Arena& kept = session_.sides().kept(poses.size());
  kept.reset();  // of a pose that came to nothing
  return timed("Pose", control, [&](pipeline::StageContext& context, StageRecord& record) -> Result<void> {
    const Arena::Mark mark(session_.output());
    RELIEVO_TRY_ASSIGN(pipeline::HeadPose pose, runner_.measure_pose(pair, context, kept));
    if (pose.drift.verdict == pipeline::DriftVerdict::Refuse) return error_of(pose.drift);
    poses.push_back(std::move(pose));
    record.in = poses.size();
    return {};
  });
}

Result<void> HeadJob::fuse(JobControl& control, std::vector<pipeline::HeadPose>& poses) {
  return timed("Fuse", control, [&](pipeline::StageContext& context, StageRecord& record) -> Result<void> {
    record.in = poses.size();
    RELIEVO_TRY_ASSIGN(pipeline::FusedHead head, runner_.fuse(*session_.products().model, poses, context));
    record.out = head.model.mesh.triangles.size();
    session_.products().model = std::move(head.model);
    return {};
  });
}

}  // namespace relievo::firmware

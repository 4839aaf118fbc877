// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// HeadJob: beside a head that turns, all stages of its frontal pair; then every side as it comes, and when no
// more come the head of all of them. What goes wrong with a side costs that side: without any that fits, the
// face of the frontal pair stays as it is. Thread: run() worker; parts_done() any; the others main, once it
// has ended. Errors: those of the frontal pair's stages, Cancelled.
#pragma once

#include <atomic>
#include <vector>

#include "firmware/work/jobs.h"

namespace relievo::firmware {

class HeadJob final : public Job {
 public:
  HeadJob(StageRunner& runner, EnrolmentSession& session, ThreadPool& pool, const hal::Clock& clock)
      : runner_(runner), session_(session), pool_(pool), clock_(clock), stage_(runner, session, pool, clock) {
    records_.reserve(kStages.size() + SidePairs::kPoses + 1);
  }
  // Stages, whose pictures may be shown, then sides; PortraitProgress::kFuse from there on.
  std::size_t parts_done() const { return parts_done_.load(std::memory_order_acquire); }
  const std::vector<StageRecord>& records() const { return records_; }
  Result<void> run(JobControl& control) override;

 private:
  Result<void> measure(const pipeline::StereoFrame& pair, JobControl& control,
                       std::vector<pipeline::HeadPose>& poses);
  Result<void> fuse(JobControl& control, std::vector<pipeline::HeadPose>& poses);
  template <typename Work>
  auto timed(std::string_view name, JobControl& control, Work&& work);

  StageRunner& runner_;
  EnrolmentSession& session_;
  ThreadPool& pool_;
  const hal::Clock& clock_;
  StageJob stage_;
  pipeline::Progress inner_;  // of one part
  std::atomic<std::size_t> parts_done_{0};
  std::vector<StageRecord> records_;
};

}  // namespace relievo::firmware

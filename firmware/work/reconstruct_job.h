// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ReconstructJob: all stages in a row, or the last of them, on a frame that lies in the session already.
// What the machine does state by state, as one job for commands that have no machine. Errors: those of the
// stage that failed. Thread: worker; stage() and records() any, records() once done.
#pragma once

#include <atomic>
#include <vector>

#include "firmware/work/jobs.h"

namespace relievo::firmware {

class ReconstructJob final : public Job {
 public:
  ReconstructJob(StageRunner& runner, EnrolmentSession& session, ThreadPool& pool, const hal::Clock& clock)
      : stage_(runner, session, pool, clock), clock_(clock) {}

  State stage() const { return now_.load(std::memory_order_relaxed); }  // the one that runs, or ran last
  const std::vector<StageRecord>& records() const { return records_; }
  std::chrono::nanoseconds took() const { return took_; }
  // The stages before this one are done, their products in the session. While it does not run.
  void begin_with(State stage) { first_ = stage; }
  Result<void> run(JobControl& control) override;

 private:
  StageJob stage_;
  const hal::Clock& clock_;
  State first_ = State::Match;
  std::atomic<State> now_{State::Match};
  std::vector<StageRecord> records_;
  std::chrono::nanoseconds took_{0};
};

}  // namespace relievo::firmware

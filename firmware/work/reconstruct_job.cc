// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/work/reconstruct_job.h"

namespace relievo::firmware {

Result<void> ReconstructJob::run(JobControl& control) {
  records_.clear();
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

}  // namespace relievo::firmware

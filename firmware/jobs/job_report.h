// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// JobReport: what a thread says when a job has ended. JobReports: the queue in which the main thread
// hears it; of fixed length, so that nothing grows. One report per running job: it cannot overflow.
// Thread: any thread puts, main takes.
#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>

#include "firmware/base/budget.h"
#include "hal/base/assert.h"
#include "hal/base/result.h"

namespace relievo::firmware {

using JobId = std::uint32_t;  // 0 is no job

struct JobReport {
  JobId job = 0;
  std::optional<Error> error;  // nothing: done
};

class JobReports {
 public:
  void put(const JobReport& report) {
    {
      const std::lock_guard lock(mutex_);
      RELIEVO_ASSERT(count_ < ring_.size());
      ring_[(first_ + count_++) % ring_.size()] = report;
    }
    arrived_.notify_one();
  }
  // Waits until something arrives or the time is over.
  std::optional<JobReport> take_for(std::chrono::milliseconds wait) {
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, wait, [this] { return count_ > 0; });
    if (count_ == 0) return std::nullopt;
    const JobReport report = ring_[first_];
    first_ = (first_ + 1) % ring_.size();
    --count_;
    return report;
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::array<JobReport, budget::kEventQueueLength> ring_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace relievo::firmware

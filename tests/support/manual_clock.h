// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ManualClock: time that only moves when a test says so.
// Thread: any.
#pragma once

#include <atomic>

#include "hal/clock.h"

namespace relievo::hal {

class ManualClock final : public Clock {
 public:
  Instant now() const override { return Instant(std::chrono::nanoseconds(since_start_ns_.load())); }
  std::chrono::system_clock::time_point wall_now() const override {
    // 2026-01-01 00:00:00 UTC: a date, but no test's own birthday.
    return std::chrono::system_clock::time_point(std::chrono::seconds(1767225600)) +
           std::chrono::duration_cast<std::chrono::system_clock::duration>(
               std::chrono::nanoseconds(since_start_ns_.load()));
  }
  void advance(std::chrono::nanoseconds by) { since_start_ns_ += by.count(); }

 private:
  std::atomic<std::int64_t> since_start_ns_{1'000'000'000};  // not zero: some code takes zero for never
};

}  // namespace relievo::hal

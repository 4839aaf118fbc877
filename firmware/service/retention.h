// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Retention: records whose newest consent is older than the operator allows are erased, once a day, while
// nobody is at the screen. A clock that has jumped ahead must not empty the store: the store remembers the
// last time that was seen, and where the clock is more than kMostLeap after it nothing is erased until
// somebody of the staff chooses the time anew. Thread: erase_expired(), trust_clock(): the keeper;
// RetentionWatch: main. Errors: InvalidState (the clock has jumped), Cancelled, the store's.
#pragma once

#include <chrono>

#include "firmware/records/event_log.h"
#include "firmware/service/side_tasks.h"
#include "storage/store.h"
#include "ui/device/settings.h"

namespace relievo::firmware {

inline constexpr std::chrono::days kMostLeap{60};  // a device may stand unplugged for so long
inline constexpr const char* kClockSeenSetting = "clock.seen";

// The clock is right: so says somebody who has looked at it.
Result<void> trust_clock(storage::Store& store, storage::WallTime now);
// Whoever reads the store meanwhile keeps traces in its log, and nobody in the store: no error. Thread: the
// keeper. Errors: NotFound; the store's, and then the person is still there.
Result<void> erase_person(storage::Store& store, storage::SubjectId id);
// A record's age is that of its newest consent. `erased`: how many were, also where it ends early.
Result<void> erase_expired(storage::Store& store, storage::WallTime now, int keep_days, JobControl& control,
                           int& erased);

class RetentionWatch {
 public:
  RetentionWatch(storage::Store& store, SideTasks& side_tasks, EventLog& log, const hal::Clock& clock)
      : store_(store), side_tasks_(side_tasks), log_(log), clock_(clock) {}
  // Once every turn in which nobody is at the screen.
  void turn(const ui::Settings& settings);
  bool clock_jumped() const { return jumped_; }
  // The time of keeping was chosen anew: look again.
  void begin_anew() {
    next_ = {};
    jumped_ = false;
  }

 private:
  storage::Store& store_;
  SideTasks& side_tasks_;
  EventLog& log_;
  const hal::Clock& clock_;
  hal::Instant next_{};
  bool jumped_ = false;
};

}  // namespace relievo::firmware

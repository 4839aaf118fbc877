// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// DeviceSettings: the staff's settings as they hold now, and the way to change one: checked, written in one
// transaction of the store, and in force when it is there. What cannot be written does not hold. Thread:
// main; it is written on the keeper. Errors of look(): the store's.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "firmware/base/settings.h"
#include "firmware/records/event_log.h"
#include "firmware/service/side_tasks.h"
#include "storage/store.h"

namespace relievo::firmware {

class DeviceSettings {
 public:
  using Done = std::function<void(const std::optional<Error>&)>;
  DeviceSettings(storage::Store& store, SideTasks& side_tasks, EventLog& log, const hal::Clock& clock)
      : store_(store), side_tasks_(side_tasks), log_(log), clock_(clock) {}

  // Before any thread uses the store. A value that is none is told in the log.
  Result<void> look();
  const ui::Settings& now() const { return now_; }
  // As they will be when everything that was asked for has been written.
  const ui::Settings& wanted() const { return wanted_; }
  // Nothing where that is no value of it.
  void change(ui::Setting setting, std::int32_t value, Done done);

 private:
  storage::Store& store_;
  SideTasks& side_tasks_;
  EventLog& log_;
  const hal::Clock& clock_;
  ui::Settings now_, wanted_;
  std::vector<std::pair<ui::Setting, std::int32_t>> asked_;  // not written yet, the eldest first
};

// Retention: records whose newest consent is older than the operator allows are erased, once a day, while
// nobody is at the screen. A clock that has jumped ahead must not empty the store: the store remembers the
// last time that was seen, and where the clock is more than kMostLeap after it nothing is erased until
// somebody of the staff chooses the time anew. Thread: erase_expired(), trust_clock(): the keeper;
// RetentionWatch: main. Errors: InvalidState (the clock has jumped), Cancelled, the store's.

inline constexpr std::chrono::days kMostLeap{60};  // a device may stand unplugged for so long
inline constexpr const char* kClockSeenSetting = "clock.seen";

// The clock is right: so says somebody who has looked at it.
Result<void> trust_clock(storage::Store& store, storage::WallTime now);
// What goes wrong once the person is gone is no error, but for the log: that an older copy would bring them
// back. Whoever reads the store meanwhile keeps traces in its log, and nobody in the store. Thread: the
// keeper. Errors: NotFound; the store's, and then the person is still there.
Result<void> erase_person(storage::Store& store, storage::SubjectId id, EventLog& log);
// A record's age is that of its newest consent. `erased`: how many were, also where it ends early.
Result<void> erase_expired(storage::Store& store, storage::WallTime now, int keep_days, EventLog& log,
                           JobControl& control, int& erased);

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

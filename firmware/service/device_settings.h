// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// DeviceSettings: the staff's settings as they hold now, and the way to change one: checked, written in one
// transaction of the store, and in force when it is there. What cannot be written does not hold. Thread:
// main; it is written on the keeper. Errors of look(): the store's.
#pragma once

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
  // False where that is no value of it.
  bool change(ui::Setting setting, std::int32_t value, Done done);

 private:
  storage::Store& store_;
  SideTasks& side_tasks_;
  EventLog& log_;
  const hal::Clock& clock_;
  ui::Settings now_, wanted_;
  std::vector<std::pair<ui::Setting, std::int32_t>> asked_;  // not written yet, the eldest first
};

}  // namespace relievo::firmware

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Statistics: how many came, what became of it, how long it took; of the last days also each by itself.
// Numbers only. Kept in the store's setting "statistics", as text; one that cannot be read begins at nothing.
// A day that lies before the newest one (a clock was set back) counts as the newest.
// Thread: noted() and view() main; text() main, its saving the keeper. Errors: none.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "firmware/machine/machine.h"
#include "hal/base/result.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {

inline constexpr const char* kStatisticsSetting = "statistics";

class Statistics {
 public:
  // `problem`: what the appliance said last; `total`: of all stages of this capture.
  void noted(const Change& change, const Error* problem, std::chrono::nanoseconds total,
             std::chrono::sys_days today);
  void begin(std::string_view date) { since_ = date; }
  std::uint64_t changes() const { return changes_; }

  std::string text() const;
  bool read(std::string_view text);
  // Borrows the date.
  ui::StatisticsView view(std::chrono::sys_days today) const;

 private:
  struct Day {
    std::uint64_t visits = 0, stored = 0, refused = 0;
  };
  void turn_to(std::chrono::sys_days today);
  static constexpr std::size_t kSteps = 128;  // of kStep each; the last one takes the rest
  static constexpr std::chrono::milliseconds kStep{250};
  double seconds_within(double share) const;

  std::string since_;
  std::uint64_t visits_ = 0, captures_ = 0, models_ = 0, stored_ = 0, left_ = 0, changes_ = 0;
  std::array<std::uint64_t, ui::kRefusals> refused_{};
  std::array<std::uint64_t, kSteps> times_{};
  std::chrono::sys_days newest_{};
  std::array<Day, ui::kStatisticsDays> days_{};  // the last is the newest
};

}  // namespace relievo::firmware

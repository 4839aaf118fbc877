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
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "firmware/machine/machine.h"
#include "firmware/work/stage_runner.h"
#include "hal/base/result.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {

inline constexpr const char* kStatisticsSetting = "statistics";

class Statistics {
 public:
  // `problem`: what the appliance said last; `total`: of all stages of this capture.
  void noted(const Transition& change, const Error* problem, std::chrono::nanoseconds total,
             std::chrono::sys_days today);
  void begin(std::string_view date) { since_ = date; }
  // Since the last call.
  bool take_changed() { return std::exchange(changed_, false); }

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
  std::uint64_t visits_ = 0, captures_ = 0, models_ = 0, stored_ = 0, left_ = 0;
  bool changed_ = false;
  std::array<std::uint64_t, ui::kRefusals> refused_{};
  std::array<std::uint64_t, kSteps> times_{};
  std::chrono::sys_days newest_{};
  std::array<Day, ui::kStatisticsDays> days_{};  // the last is the newest
};

// VisitCosts: what the last visits cost, stage by stage: seconds, arenas' peaks, the program's resident size.
// Noted when a visit ends, because its session is wiped then. Numbers only. Kept in the store's setting
// "visit.costs", as text; one that cannot be read begins at nothing.
// Thread: noted(), view(), text() main; what text() gives is saved on the keeper. Errors: none.
inline constexpr const char* kVisitCostsSetting = "visit.costs";

class VisitCosts {
 public:
  // Visits that are kept; an older one goes for each that comes.
  static constexpr std::size_t kKept = 16;
  void noted(std::span<const StageRecord> records, std::uint64_t resident_bytes);
  // The most that any of the kept visits took.
  ui::VisitCostsView view() const;
  static std::string_view name_of(ui::CostlyStage stage);
  // Since the last call.
  bool take_changed() { return std::exchange(changed_, false); }
  std::string text() const;
  bool read(std::string_view text);

 private:
  struct Visit {
    std::array<ui::StageCost, ui::kCostlyStages> stages{};
    float resident_mib = 0;
  };
  std::array<Visit, kKept> visits_{};  // a ring
  std::size_t count_ = 0, next_ = 0;
  bool changed_ = false;
};

}  // namespace relievo::firmware

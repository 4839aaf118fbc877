// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// VisitCosts: what the last visits cost, stage by stage: seconds, arenas' peaks, the program's resident size.
// Noted when a visit ends, because its session is wiped then. Numbers only. Kept in the store's setting
// "visit.costs", as text; one that cannot be read begins at nothing.
// Thread: noted(), view(), text() main; what text() gives is saved on the keeper. Errors: none.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "firmware/work/stage_runner.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {

inline constexpr const char* kVisitCostsSetting = "visit.costs";

class VisitCosts {
 public:
  // Visits that are kept; an older one goes for each that comes.
  static constexpr std::size_t kKept = 16;
  void noted(std::span<const StageRecord> records, std::uint64_t resident_bytes);
  // The most that any of the kept visits took.
  ui::VisitCostsView view() const;
  static std::string_view name_of(ui::CostlyStage stage);
  std::uint64_t changes() const { return changes_; }
  std::string text() const;
  bool read(std::string_view text);

 private:
  struct Visit {
    std::array<ui::StageCost, ui::kCostlyStages> stages{};
    float resident_mib = 0;
  };
  std::array<Visit, kKept> visits_{};  // a ring
  std::size_t count_ = 0, next_ = 0;
  std::uint64_t changes_ = 0;
};

}  // namespace relievo::firmware

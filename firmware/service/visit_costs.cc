// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/visit_costs.h"

#include <algorithm>
#include <chrono>
#include <sstream>

#include "firmware/base/budget.h"

namespace relievo::firmware {
namespace {

// As the jobs call their parts, in the order of ui::CostlyStage.
constexpr std::array<std::string_view, ui::kCostlyStages> kNames{"Match",    "Reconstruct", "Mesh", "Texture",
                                                                 "Assemble", "Pose",        "Fuse"};

float to_mib(std::uint64_t bytes) { return float(bytes) / float(budget::kMiB); }

}  // namespace

std::string_view VisitCosts::name_of(ui::CostlyStage stage) { return kNames[std::size_t(stage)]; }

void VisitCosts::noted(std::span<const StageRecord> records, std::uint64_t resident_bytes) {
  if (records.empty()) return;
  Visit visit;
  for (const StageRecord& record : records) {
    const auto name = std::find(kNames.begin(), kNames.end(), record.name);
    if (name == kNames.end()) continue;
    ui::StageCost& cost = visit.stages[std::size_t(name - kNames.begin())];
    cost.seconds = std::max(cost.seconds, std::chrono::duration<float>(record.took).count());
    cost.mib = std::max(cost.mib, to_mib(record.arena_peak_bytes));
  }
  visit.resident_mib = to_mib(resident_bytes);
  visits_[next_] = visit;
  next_ = (next_ + 1) % kKept;
  count_ = std::min(count_ + 1, kKept);
  ++changes_;
}

ui::VisitCostsView VisitCosts::view() const {
  ui::VisitCostsView most;
  most.visits = int(count_);
  for (std::size_t i = 0; i < count_; ++i) {
    for (std::size_t k = 0; k < ui::kCostlyStages; ++k) {
      most.stages[k].seconds = std::max(most.stages[k].seconds, visits_[i].stages[k].seconds);
      most.stages[k].mib = std::max(most.stages[k].mib, visits_[i].stages[k].mib);
    }
    most.resident_mib = std::max(most.resident_mib, visits_[i].resident_mib);
  }
  most.planned_seconds = std::chrono::duration<float>(budget::kStageLimit).count();
  return most;
}

std::string VisitCosts::text() const {
  std::ostringstream out;
  out << "1 " << count_;
  for (std::size_t i = 0; i < count_; ++i) {  // oldest first
    const Visit& visit = visits_[(next_ + kKept - count_ + i) % kKept];
    for (const ui::StageCost& cost : visit.stages) out << ' ' << cost.seconds << ' ' << cost.mib;
    out << ' ' << visit.resident_mib;
  }
  return out.str();
}

bool VisitCosts::read(std::string_view text) {
  std::istringstream in{std::string(text)};
  VisitCosts seen;
  std::string version;
  in >> version >> seen.count_;
  if (!in || version != "1" || seen.count_ > kKept) return false;
  for (std::size_t i = 0; i < seen.count_; ++i) {
    for (ui::StageCost& cost : seen.visits_[i].stages) in >> cost.seconds >> cost.mib;
    in >> seen.visits_[i].resident_mib;
  }
  if (!in) return false;
  seen.next_ = seen.count_ % kKept;
  *this = seen;
  return true;
}

}  // namespace relievo::firmware

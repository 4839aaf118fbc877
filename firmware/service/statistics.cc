// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/statistics.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "firmware/base/budget.h"

namespace relievo::firmware {
namespace {

// Without the record's storing, which nobody can leave.
bool is_visit(State state) { return is_of_a_visit(state) && state != State::Store; }

// Others are ui::Refusal::Other.
constexpr std::pair<Errc, ui::Refusal> kRefusals[] = {
    {Errc::NoFace, ui::Refusal::NoFace},
    {Errc::TooFewMatches, ui::Refusal::TooFewMatches},
    {Errc::PoorGeometry, ui::Refusal::PoorGeometry},
    {Errc::OutOfMemory, ui::Refusal::Memory},
    {Errc::Disconnected, ui::Refusal::Camera},
    {Errc::Timeout, ui::Refusal::Slow},
};

ui::Refusal refusal_of(const Error& error) {
  const auto* const found = std::ranges::find(kRefusals, error.code, &std::pair<Errc, ui::Refusal>::first);
  return found != std::end(kRefusals) ? found->second : ui::Refusal::Other;
}

// As the jobs call their parts, in the order of ui::CostlyStage.
constexpr std::array<std::string_view, ui::kCostlyStages> kNames{"Match",    "Reconstruct", "Mesh", "Texture",
                                                                 "Assemble", "Pose",        "Fuse"};

float to_mib(std::uint64_t bytes) { return float(bytes) / float(budget::kMiB); }

}  // namespace

// The days between the newest and this one had nobody.
void Statistics::turn_to(std::chrono::sys_days today) {
  const auto on = std::clamp<std::int64_t>((today - newest_).count(), 0, ui::kStatisticsDays);
  std::shift_left(days_.begin(), days_.end(), std::ptrdiff_t(on));
  std::fill(days_.end() - std::ptrdiff_t(on), days_.end(), Day{});
  newest_ = std::max(newest_, today);
}

void Statistics::noted(const Transition& change, const Error* problem, std::chrono::nanoseconds total,
                       std::chrono::sys_days today) {
  turn_to(today);
  Day& day = days_.back();
  const auto count = [this](std::uint64_t& number) { ++number, changed_ = true; };
  const auto count_today = [&](std::uint64_t& number, std::uint64_t& of_day) { count(number), ++of_day; };
  // Fuse goes on to a model: who turned for too long is not refused.
  const bool refused = is_visit(change.from) && change.from != State::Review && change.to != State::Fuse &&
                       (change.event == Event::AdviceGiven || change.event == Event::StageFailed ||
                        change.event == Event::Failed || change.event == Event::Timeout);
  if (change.from == State::Idle && is_visit(change.to)) count_today(visits_, day.visits);
  if (change.from == State::Capture && (change.event == Event::Triggered || change.event == Event::TurnAsked))
    count(captures_);
  if (change.to == State::Review && (change.from == State::Assemble || change.from == State::Fuse)) {
    count(models_);
    ++times_[std::min(kSteps - 1, std::size_t(total / kStep))];
  }
  if (change.from == State::Store && change.event == Event::StageDone) count_today(stored_, day.stored);
  if (is_visit(change.from) && change.to == State::Idle) count(left_);
  if (refused && change.from != State::Position)
    count_today(refused_[std::size_t(problem != nullptr ? refusal_of(*problem) : ui::Refusal::Other)],
                day.refused);
}

std::string Statistics::text() const {
  std::ostringstream out;
  out << "2 " << since_ << ' ' << visits_ << ' ' << captures_ << ' ' << models_ << ' ' << stored_ << ' '
      << left_;
  for (const std::uint64_t n : refused_) out << ' ' << n;
  for (const std::uint64_t n : times_) out << ' ' << n;
  out << ' ' << newest_.time_since_epoch().count();
  for (const Day& day : days_) out << ' ' << day.visits << ' ' << day.stored << ' ' << day.refused;
  return out.str();
}

bool Statistics::read(std::string_view text) {
  std::istringstream in{std::string(text)};
  Statistics seen;
  std::string version;
  in >> version >> seen.since_ >> seen.visits_ >> seen.captures_ >> seen.models_ >> seen.stored_ >>
      seen.left_;
  for (std::uint64_t& n : seen.refused_) in >> n;
  for (std::uint64_t& n : seen.times_) in >> n;
  std::int64_t newest = 0;
  in >> newest;
  seen.newest_ = std::chrono::sys_days(std::chrono::days(newest));
  for (Day& day : seen.days_) in >> day.visits >> day.stored >> day.refused;
  if (!in || version != "2") return false;
  *this = seen;
  return true;
}

// The upper end of the step below which so large a share lies.
double Statistics::seconds_within(double share) const {
  std::uint64_t all = 0, below = 0;
  for (const std::uint64_t n : times_) all += n;
  if (all == 0) return 0;
  std::size_t step = 0;
  for (; step < kSteps; ++step) {
    below += times_[step];
    if (double(below) >= share * double(all)) break;
  }
  return std::chrono::duration<double>(kStep * (int(step) + 1)).count();
}

ui::StatisticsView Statistics::view(std::chrono::sys_days today) const {
  Statistics now = *this;
  now.turn_to(today);
  ui::StatisticsView view{
      since_, visits_, captures_, models_, stored_, left_, refused_, seconds_within(0.5), seconds_within(0.9),
      {}};
  for (std::size_t i = 0; i < ui::kStatisticsDays; ++i) {
    const std::chrono::year_month_day date(now.newest_ -
                                           std::chrono::days(std::int64_t(ui::kStatisticsDays - 1 - i)));
    std::snprintf(view.days.date[i].data(), view.days.date[i].size(), "%04u-%02u-%02u",
                  static_cast<unsigned>(int(date.year())) % 10000U,
                  static_cast<unsigned>(date.month()) % 100U, static_cast<unsigned>(date.day()) % 100U);
    view.days.visits[i] = float(now.days_[i].visits);
    view.days.stored[i] = float(now.days_[i].stored);
    view.days.refused[i] = float(now.days_[i].refused);
  }
  return view;
}

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
  changed_ = true;
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

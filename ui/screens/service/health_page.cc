// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The memory plan against what was really used, disk, temperatures, the last faults.
#include <algorithm>
#include <array>
#include <cstdio>

#include "ui/screens/service/staff_frame.h"
#include "ui/view/staff_views.h"

namespace relievo::ui {
namespace {

constexpr double kManyMib = 10 * 1024;  // from here on a figure is easier read, and fits its line, in GiB

// In the order of Gauge.
constexpr std::array kGaugeNames{mark_tr("Memory of the stages"), mark_tr("Memory of the whole program"),
                                 mark_tr("Disk used"), mark_tr("Temperature")};
static_assert(kGaugeNames.size() == std::size_t(Gauge::Temperature) + 1);

constexpr std::size_t kMostSamples = 256;

// What was kept over a day, in the unit of its row.
void over_a_day(StaffFrame& page, const GaugeRow& row, Plot plot, bool gib) {
  std::array<float, kMostSamples> values;
  const std::size_t count = std::min(values.size(), row.day.size());
  for (std::size_t i = 0; i < count; ++i) values[i] = gib ? row.day[i] / 1024 : row.day[i];
  plot.values = {values.data(), count};
  plot.look = PlotLook::Line;
  plot.unit = row.gauge == Gauge::Temperature ? "°C" : gib ? "GiB" : "MiB";
  plot.limit = float(gib ? row.of / 1024 : row.of);
  std::array<std::string_view, kMostSamples> hours;
  for (std::size_t i = 0; i < count; ++i)
    hours[i] = page.number(-24 * double(count - 1 - i) / double(count), 1, "h");
  plot.names = {hours.data(), count};
  plot.under = {page.number(-24, 0, "h"), page.number(-12, 0, "h"), page.tr("Now")};
  plot.figure_ink = page.ink_of(row.mood);
  plot.figure_sign = page.sign_of(row.mood);
  page.plot(plot);
}

void gauge_row(StaffFrame& page, const GaugeRow& row, std::size_t index) {
  char text[64]{};
  const bool gib = row.of >= kManyMib;
  const double unit_mib = gib ? 1024 : 1;
  std::snprintf(text, sizeof text, "\u2066%.0f\u00a0/\u00a0%.0f\u00a0%s\u2069", row.used / unit_mib,
                row.of / unit_mib, gib ? "GiB" : "MiB");
  const std::string_view value =
      row.gauge == Gauge::Temperature ? page.number(row.used, 0, "°C") : page.tree.keep(text);
  const char* words = one_of(page.tr, kGaugeNames, row.gauge);
  char named[160];  // the words stand outside of any isolate: they tell the direction, also of a Latin name
  std::snprintf(named, sizeof named, "%s ({})", words);
  Plot plot;
  plot.id = page.id("gauge", index);
  plot.title = row.name.empty() ? std::string_view(words) : page.filled(named, {row.name});
  plot.figure = value;
  if (!row.day.empty()) return over_a_day(page, row, plot, gib);
  page.row(plot.id, plot.title, value, row.mood);
}

// In the order of CostlyStage.
constexpr std::array kStageNames{mark_tr("Matching"),  mark_tr("Reconstruction"),
                                 mark_tr("Surface"),   mark_tr("Texture"),
                                 mark_tr("Landmarks"), mark_tr("Pictures of the sides of the head"),
                                 mark_tr("Model")};
static_assert(kStageNames.size() == std::size_t(CostlyStage::Count));

// Time and memory of every stage, at most in one of the last visits, and what it may take.
void stage_rows(StaffFrame& page, const VisitCostsView& costs) {
  page.section(page.tr("From the pictures to the portrait"));
  page.row("costly visits", page.tr("Visits begun"), page.number(costs.visits));
  for (std::size_t i = 0; i < kCostlyStages; ++i) {
    const StageCost& cost = costs.stages[i];
    if (cost.seconds <= 0) continue;
    char text[96];
    std::snprintf(text, sizeof text, "%.1f / %.0f s  ·  %.0f / %.0f MiB", double(cost.seconds),
                  double(costs.planned_seconds), double(cost.mib), double(costs.planned_stage_mib));
    const bool over = cost.seconds > costs.planned_seconds || cost.mib > costs.planned_stage_mib;
    page.row(page.id("cost", i), one_of(page.tr, kStageNames, i), page.with_numbers(text),
             over ? Mood::Bad : Mood::Good);
  }
}

}  // namespace

void health_page(StaffFrame& page) {
  const auto& tr = page.tr;
  page.begin_list("health");
  if (page.staff.health == nullptr) {
    page.line(tr("One moment, please"));
    return page.tree.close();
  }
  page.section(tr("Used at most, and what was planned"));
  std::size_t index = 0;
  for (const GaugeRow& row : page.staff.health->gauges) gauge_row(page, row, index++);
  if (page.staff.health->costs.visits > 0) stage_rows(page, page.staff.health->costs);
  page.section(tr("Last faults"));
  for (const LogLine& fault : page.staff.health->faults) page.logged(fault);
  if (page.staff.health->faults.empty()) page.line(tr("There is none yet"), Mood::Good);
  page.tree.close();
}

}  // namespace relievo::ui

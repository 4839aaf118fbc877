// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many came, what became of it, and how long it took: numbers, nobody's name.
#include <array>

#include "ui/screens/service/staff_pages.h"
#include "ui/view/staff_views.h"

namespace relievo::ui {
namespace {

// In the order of Refusal.
constexpr std::array kRefusalWords{mark_tr("No face found"),
                                   mark_tr("Too little could be matched"),
                                   mark_tr("The measurement is not good enough"),
                                   mark_tr("Not enough memory"),
                                   mark_tr("A camera does not answer"),
                                   mark_tr("It took too long"),
                                   mark_tr("Another reason")};
static_assert(kRefusalWords.size() == static_cast<std::size_t>(Refusal::Count));

const char* words_of(const Words& tr, Refusal refusal) {
  return tr(kRefusalWords[static_cast<std::size_t>(refusal)]);
}

void days(StaffFrame& page, const StatisticsView& seen) {
  std::array<std::string_view, kStatisticsDays> dates;
  for (std::size_t i = 0; i < dates.size(); ++i) dates[i] = page.date(seen.days.date[i].data());
  std::uint64_t refused = 0;
  for (const std::uint64_t count : seen.refused) refused += count;
  const auto count = [&](std::string_view id, const char* title, std::uint64_t all, const auto& values) {
    Plot plot;
    plot.id = id, plot.title = title, plot.figure = page.number(static_cast<double>(all));
    plot.values = values, plot.names = dates;
    page.plot(plot);
  };
  count("visits", page.tr("Visits begun"), seen.visits, seen.days.visits);
  count("stored", page.tr("Portraits kept"), seen.stored, seen.days.stored);
  count("refused", page.tr("Refused captures"), refused, seen.days.refused);
}

}  // namespace

void statistics_page(StaffFrame& page) {
  const auto& tr = page.tr;
  const StatisticsView* seen = page.staff.statistics;
  page.begin_list("statistics");
  if (seen == nullptr) {
    page.line(tr("One moment, please"));
    return page.tree.close();
  }
  const auto count = [&](std::uint64_t value) { return page.number(static_cast<double>(value)); };
  page.row("since", tr("Counted since"), page.date(seen->since));
  page.row("captures", tr("Captures"), count(seen->captures));
  page.row("models", tr("Portraits made"), count(seen->models));
  page.row("left", tr("Visits left early"), count(seen->left));
  days(page, *seen);
  for (std::size_t i = 0; i < kRefusals; ++i) {
    if (seen->refused[i] == 0) continue;
    const auto refusal = static_cast<Refusal>(i);
    const std::string_view id = page.tree.keep("refused "), which = page.number(static_cast<double>(i));
    page.row({id.data(), id.size() + which.size()}, words_of(tr, refusal), count(seen->refused[i]));
  }
  page.section(tr("From the pictures to the portrait"));
  page.row("median", tr("Half of them are faster than"),
           seen->median_s > 0 ? page.number(seen->median_s, 1, "s") : std::string_view("–"));
  page.row("slow", tr("Nine of ten are faster than"),
           seen->slow_s > 0 ? page.number(seen->slow_s, 1, "s") : std::string_view("–"));
  page.tree.close();
}

}  // namespace relievo::ui

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the staff let the device say of itself: figures of its visits, consent texts, self-test, trigger test,
// log.
#include <array>

#include "ui/screens/service/staff_frame.h"
#include "ui/view/staff_views.h"

namespace relievo::ui {

// How many came, what became of it, and how long it took: numbers, nobody's name.
namespace {

// In the order of Refusal.
constexpr std::array kRefusalWords{mark_tr("No face found"),
                                   mark_tr("Too little could be matched"),
                                   mark_tr("The measurement is not good enough"),
                                   mark_tr("Not enough memory"),
                                   mark_tr("A camera does not answer"),
                                   mark_tr("It took too long"),
                                   mark_tr("Another reason")};
static_assert(kRefusalWords.size() == std::size_t(Refusal::Count));

void days(StaffFrame& page, const StatisticsView& seen) {
  std::array<std::string_view, kStatisticsDays> dates;
  for (std::size_t i = 0; i < dates.size(); ++i) dates[i] = page.date(seen.days.date[i].data());
  std::uint64_t refused = 0;
  for (const std::uint64_t count : seen.refused) refused += count;
  const auto count = [&](std::string_view id, const char* title, std::uint64_t all, const auto& values) {
    Plot plot;
    plot.id = id, plot.title = title, plot.figure = page.number(all);
    plot.values = values, plot.names = dates;
    page.plot(plot);
  };
  count("visits", page.tr("Visits begun"), seen.visits, seen.days.visits);
  count("stored", page.tr("Portraits kept"), seen.stored, seen.days.stored);
  count("refused", page.tr("Refused captures"), refused, seen.days.refused);
}

// Every language with the title its visitors read.
void titles(StaffFrame& page, const ConsentTexts& own) {
  for (std::size_t i = 0; i < kLanguages; ++i) {
    const auto language = static_cast<Language>(i);
    const ConsentText* text = own.of(language);
    if (text != nullptr) page.row(info_of(language).code, info_of(language).own_name, text->title);
  }
}

void ended(StaffFrame& page, const ConsentTextsView& seen) {
  const auto& tr = page.tr;
  if (seen.taking) return page.status("outcome", tr("One moment, please"), Mood::Plain);
  if (seen.outcome == Outcome::None) return;
  if (seen.outcome == Outcome::Done) return page.status("outcome", tr("It applies from now on."), Mood::Good);
  if (seen.outcome == Outcome::NoStick || seen.outcome == Outcome::StickGone) {
    page.outcome(seen.outcome);
  } else if (seen.fault != nullptr) {
    page.status("outcome", words_of(tr, seen.fault->code), Mood::Bad);
    page.detail(seen.fault->detail);
  }
  page.line(tr("Nothing was changed."));
}

// In the order of Check.
constexpr std::array kCheckNames{mark_tr("Memory"), mark_tr("Store"), mark_tr("Calibration"),
                                 mark_tr("Room on the disk"), mark_tr("Cameras")};
static_assert(kCheckNames.size() == std::size_t(Check::Count));

// In the order of CheckState.
constexpr std::array kCheckWords{"–", mark_tr("One moment, please"), mark_tr("In order"),
                                 mark_tr("Not in order")};
static_assert(kCheckWords.size() == std::size_t(CheckState::Bad) + 1);

Mood mood_of(CheckState state) {
  return state == CheckState::Good ? Mood::Good : state == CheckState::Bad ? Mood::Bad : Mood::Plain;
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
  page.row("since", tr("Counted since"), page.date(seen->since));
  page.row("captures", tr("Captures"), page.number(seen->captures));
  page.row("models", tr("Portraits made"), page.number(seen->models));
  page.row("left", tr("Visits left early"), page.number(seen->left));
  days(page, *seen);
  for (std::size_t i = 0; i < kRefusals; ++i) {
    if (seen->refused[i] == 0) continue;
    page.row(page.id("refused", i), one_of(tr, kRefusalWords, i), page.number(seen->refused[i]));
  }
  page.section(tr("From the pictures to the portrait"));
  const auto time = [&](double s) { return s > 0 ? page.number(s, 1, "s") : std::string_view("–"); };
  page.row("median", tr("Half of them are faster than"), time(seen->median_s));
  page.row("slow", tr("Nine of ten are faster than"), time(seen->slow_s));
  page.tree.close();
}

// Which consent text visitors read, and how the operator's own comes from a stick: the operator's page, and a
// step of the first start.
void consent_in_force(StaffFrame& page) {
  const auto& tr = page.tr;
  const ConsentTexts* own = page.view.consent;
  page.begin_list("consent");
  if (page.staff.consent != nullptr) ended(page, *page.staff.consent);
  if (own == nullptr) {
    page.status("in force", tr("Sample text, not reviewed by a lawyer: the operator puts their own here."),
                Mood::Warn);
  } else {
    page.status("in force",
                page.filled(tr("Visitors read your text, version {}. They are offered these languages:"),
                            own->version),
                Mood::Good);
    titles(page, *own);
  }
  page.rule();
  page.line(tr(
      "On a stick, in the folder consent/VERSION, a file for each language, saved as UTF-8: en.txt, de.txt, fr.txt, es.txt, ar.txt, he.txt, zh-Hans.txt, ja.txt. VERSION is a name of your choice, such as 2026-03; of several the last in order is taken."));
  page.line(tr(
      "The first line is the title. Then, after an empty line each, the points: a title, and the words below it."));
  page.tree.close();
  const bool busy = page.staff.consent == nullptr || page.staff.consent->taking;
  page.small_button("take consent", tr("Load from the stick"), icon::kStick, ButtonLook::Quiet,
                    busy ? Action{} : TakeConsentText{});
}

void self_test_page(StaffFrame& page) {
  const auto& tr = page.tr;
  page.begin_list("self test");
  if (const SelfTestView* seen = page.staff.self_test) {
    for (std::size_t i = 0; i < kChecks; ++i) {
      page.row(page.id("check", i), one_of(tr, kCheckNames, i), one_of(tr, kCheckWords, seen->states[i]),
               mood_of(seen->states[i]));
      if (seen->states[i] != CheckState::Bad) continue;
      page.line(words_of(tr, seen->problems[i].code), Mood::Bad);
      page.detail(seen->problems[i].detail);
    }
  }
  page.tree.close();
  page.small_button("begin", tr("Start"), icon::kAgain, ButtonLook::Main,
                    page.staff.work.running ? Action{} : BeginSelfTest{});
}

void trigger_page(StaffFrame& page) {
  const auto& tr = page.tr;
  page.body("what", tr("Ten pulses: does each reach both cameras? The lamp stays off."));
  page.begin_list("trigger");
  if (const TriggerView* seen = page.staff.trigger) {
    const bool all = seen->pairs == seen->pulses;
    page.row("pulses", tr("Pulses given"), page.number(seen->pulses));
    page.row("pairs", tr("Pairs"), page.number(seen->pairs),
             seen->pulses == 0 ? Mood::Plain
             : all             ? Mood::Good
                               : Mood::Bad);
    page.row("apart", tr("Apart in time"), page.number(seen->apart_ms, 3, "ms"));
    page.row("delay", tr("From the pulse to the picture"), page.number(seen->delay_ms, 1, "ms"));
    page.row("late", tr("Late"), page.number(seen->late));
    page.row("lost", tr("Lost"), page.number(seen->lost));
    page.row("damaged", tr("Damaged"), page.number(seen->damaged));
    if (seen->ended)
      page.line(all ? tr("In order") : tr("Some pulses were not seen by both cameras."),
                all ? Mood::Good : Mood::Bad);
  }
  page.tree.close();
  page.small_button("begin", tr("Start"), icon::kAgain, ButtonLook::Main,
                    page.staff.work.running ? Action{} : BeginTriggerTest{});
}

void log_page(StaffFrame& page) {
  const LogView* seen = page.staff.log;
  const std::string_view filters[] = {page.tr("All"), page.tr("Fault")};
  if (seen != nullptr && list_choice(page, seen->place, filters)) return;
  page.begin_list("log");
  if (seen == nullptr || seen->lines.empty()) page.line(page.tr("There is none yet"));
  else
    for (const LogLine& line : seen->lines) page.logged(line);
  page.tree.close();
  if (seen != nullptr) list_pager(page, seen->place, filters);
}

}  // namespace relievo::ui

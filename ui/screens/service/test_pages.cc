// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a technician lets the device say of itself: self-test, trigger test, log.
#include "ui/screens/service/fault_words.h"

#include <array>

#include "ui/screens/service/list_part.h"
#include "ui/screens/service/staff_pages.h"
#include "ui/view/staff_views.h"

namespace relievo::ui {
namespace {

// In the order of Check.
constexpr std::array kCheckNames{mark_tr("Memory"), mark_tr("Store"), mark_tr("Calibration"),
                                 mark_tr("Room on the disk"), mark_tr("Cameras")};
static_assert(kCheckNames.size() == static_cast<std::size_t>(Check::Count));

const char* words_of(const Words& tr, Check check) {
  return tr(kCheckNames[static_cast<std::size_t>(check)]);
}

// In the order of CheckState.
constexpr std::array kCheckWords{mark_tr("Not tested"), mark_tr("Being tested"), mark_tr("In order"),
                                 mark_tr("Not in order")};
static_assert(kCheckWords.size() == static_cast<std::size_t>(CheckState::Bad) + 1);

const char* words_of(const Words& tr, CheckState state) {
  return tr(kCheckWords[static_cast<std::size_t>(state)]);
}

Mood mood_of(CheckState state) {
  return state == CheckState::Good ? Mood::Good : state == CheckState::Bad ? Mood::Bad : Mood::Plain;
}

std::string_view numbered(StaffFrame& page, const char* what, std::size_t number) {
  const std::string_view first = page.tree.keep(what);
  const char digit = static_cast<char>('0' + number);
  return {first.data(), first.size() + page.tree.keep({&digit, 1}).size()};
}

}  // namespace

void self_test_page(StaffFrame& page) {
  const auto& tr = page.tr;
  page.begin_list("self test");
  if (const SelfTestView* seen = page.staff.self_test) {
    for (std::size_t i = 0; i < kChecks; ++i) {
      page.row(numbered(page, "check ", i), words_of(tr, static_cast<Check>(i)),
               words_of(tr, seen->states[i]), mood_of(seen->states[i]));
      if (seen->states[i] != CheckState::Bad) continue;
      page.line(words_of(tr, seen->problems[i].code), Mood::Bad);
      page.detail(seen->problems[i].detail);
    }
  }
  page.tree.close();
  page.small_button("begin", tr("Start"), icon::kAgain, ButtonLook::Main,
                    page.staff.work.running ? Action{} : Action(BeginSelfTest{}));
}

void trigger_page(StaffFrame& page) {
  const auto& tr = page.tr;
  page.body("what", tr("Ten pulses: does each reach both cameras? The lamp stays off."));
  page.begin_list("trigger");
  if (const TriggerView* seen = page.staff.trigger) {
    const auto count = [&](std::uint64_t value) { return page.number(static_cast<double>(value)); };
    const bool all = seen->pairs == seen->pulses;
    page.row("pulses", tr("Pulses given"), count(static_cast<std::uint64_t>(seen->pulses)));
    page.row("pairs", tr("Pairs seen"), count(static_cast<std::uint64_t>(seen->pairs)),
             seen->pulses == 0 ? Mood::Plain
             : all             ? Mood::Good
                               : Mood::Bad);
    page.row("apart", tr("Apart at most"), page.number(seen->apart_ms, 3, "ms"));
    page.row("delay", tr("From the pulse to the picture"), page.number(seen->delay_ms, 1, "ms"));
    page.row("late", tr("Late"), count(seen->late));
    page.row("lost", tr("Lost"), count(seen->lost));
    page.row("damaged", tr("Damaged"), count(seen->damaged));
    if (seen->ended)
      page.line(all ? tr("Every pulse was seen by both cameras.")
                    : tr("Some pulses were not seen by both cameras."),
                all ? Mood::Good : Mood::Bad);
  }
  page.tree.close();
  page.small_button("begin", tr("Start"), icon::kAgain, ButtonLook::Main,
                    page.staff.work.running ? Action{} : Action(BeginTriggerTest{}));
}

void log_page(StaffFrame& page) {
  const LogView* seen = page.staff.log;
  const std::string_view filters[] = {page.tr("All"), page.tr("Fault")};
  if (seen != nullptr && list_choice(page, seen->place, filters)) return;
  page.begin_list("log");
  if (seen == nullptr || seen->lines.empty()) page.line(page.tr("Nothing has been noted yet."));
  else
    for (const LogLine& line : seen->lines) page.logged(line);
  page.tree.close();
  if (seen != nullptr) list_pager(page, seen->place, filters);
}

}  // namespace relievo::ui

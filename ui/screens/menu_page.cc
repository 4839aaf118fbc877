// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The staff's first page: what needs a hand, then the pages a role may open, in groups. Both are made from
// tables (status_rules(), staff_pages()): what is new appears by its row.
#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "ui/screens/staff_screens.h"

namespace relievo::ui {
namespace {

using To = StaffPage;
using View = const ViewState&;
using Status = const StatusView&;

constexpr int kOldCalibrationDays = 365;
constexpr std::uint64_t kMissedShare = 100;  // one of so many pairs is no fault yet

Mood bad_if(bool wrong) { return wrong ? Mood::Bad : Mood::Plain; }
Mood warn_if(bool doubtful) { return doubtful ? Mood::Warn : Mood::Plain; }
// Before real people it must not be so.
Mood grave_before_people(View view, bool wrong) {
  return !wrong ? Mood::Plain : view.service->access.demanded ? Mood::Bad : Mood::Warn;
}
double least_mib(View view) { return view.settings.of(Setting::LeastRoomMib); }
std::size_t languages_of(View view) {
  return std::size_t(
      std::ranges::count_if(view.consent->in, [](const auto& one) { return one.has_value(); }));
}
std::string_view free_room(StaffFrame& page, Status seen) { return page.number(seen.free_mib, 0, "MiB"); }

constexpr StatusRule kRules[] = {
    {"clock", mark_tr("The clock of this device is wrong"), To::Clock, To::Clock,
     [](View view, Status) { return bad_if(view.out_of_order == Trouble::Clock); }},
    {"uncalibrated", mark_tr("The cameras must be calibrated"), To::Calibrate, To::Menu,
     [](View view, Status) { return bad_if(view.out_of_order == Trouble::Uncalibrated); }},
    {"moved", mark_tr("The cameras need adjusting"), To::Calibrate, To::Menu,
     [](View view, Status) {
       return view.out_of_order == Trouble::Calibration ? Mood::Bad : warn_if(!view.calibration_note.empty());
     }},
    {"camera", mark_tr("A camera does not answer"), To::Cameras, To::Menu,
     [](View, Status seen) { return bad_if(seen.camera_away); }},
    {"store", mark_tr("The store is damaged"), To::SelfTest, To::Menu,
     [](View, Status seen) { return bad_if(seen.store_damaged); }},
    {"no room", mark_tr("There is no room left"), To::Health, To::Records,
     [](View view, Status seen) { return bad_if(seen.free_mib < least_mib(view)); }, free_room},
    {"hot", mark_tr("Temperature"), To::Health, To::Menu,
     [](View view, Status seen) {
       const bool off = view.out_of_order == Trouble::Other || seen.hottest_c >= kHotCelsius;
       return off ? Mood::Bad : warn_if(seen.hottest_c >= kWarmCelsius);
     },
     [](StaffFrame& page, Status seen) {
       return seen.hottest_c > 0 ? page.number(seen.hottest_c, 0, "°C") : std::string_view();
     }},
    {"recovery", mark_tr("Recovery words"), To::Menu, To::Recovery,
     [](View view, Status) { return grave_before_people(view, view.service->access.words_due); },
     [](StaffFrame& page, Status) { return std::string_view(page.tr("Something is missing")); }},
    {"sample", mark_tr("Sample text, not reviewed by a lawyer: the operator puts their own here."), To::Menu,
     To::Consent, [](View view, Status) { return grave_before_people(view, view.consent == nullptr); }},
    {"languages", mark_tr("Consent text"), To::Menu, To::Consent,
     [](View view, Status) { return warn_if(view.consent != nullptr && languages_of(view) < kLanguages); },
     [](StaffFrame& page, Status) { return page.share_of(languages_of(page.view), kLanguages); }},
    {"jumped",
     mark_tr("The clock has jumped ahead: nothing is erased. Check the clock, then choose the time again."),
     To::Clock, To::Settings, [](View, Status seen) { return warn_if(seen.clock_jumped); }},
    {"little room", mark_tr("Room on the disk"), To::Health, To::Records,
     [](View view, Status seen) {
       return warn_if(seen.free_mib >= least_mib(view) && seen.free_mib < 2 * least_mib(view));
     },
     free_room},
    {"trigger", mark_tr("Some pulses were not seen by both cameras."), To::Trigger, To::Menu,
     [](View, Status seen) { return warn_if(seen.missed * kMissedShare > seen.pairs); }},
    {"old", mark_tr("Calibration"), To::Calibrate, To::Menu,
     [](View, Status seen) { return warn_if(seen.calibration_days > kOldCalibrationDays); },
     [](StaffFrame& page, Status seen) {
       const auto days = static_cast<unsigned long>(seen.calibration_days);
       return page.filled(page.tr.plural("{} day", "{} days", days), page.number(seen.calibration_days));
     }},
    {"restarted", mark_tr("This device has just restarted"), To::Log, To::Menu,
     [](View view, Status) { return warn_if(view.out_of_order == Trouble::Restarted); }},
    {"faults", mark_tr("Last faults"), To::Log, To::Menu,
     [](View, Status seen) { return warn_if(seen.device_faults > 0); },
     [](StaffFrame& page, Status seen) { return page.number(seen.device_faults); }},
};
static_assert(std::size(kRules) <= kMostFindings);

// Sign, words, what is said beside them; a button where this role can mend it, else whose work it is.
void finding(StaffFrame& page, const Finding& found) {
  const auto& tr = page.tr;
  const StaffPage where = found.rule->page_of(page.staff.role);
  const bool mine = where != StaffPage::Menu;
  Node row = page.row_box(space::kS, 0, 6);
  tell(row, mine ? Role::Button : Role::Status, page.joined({"status ", found.rule->id}),
       tr(found.rule->words));
  row.value = tr("Not in order");
  if (mine) row.action = {ActionKind::StaffOpen, int(where)};
  row.box.min_height = page.px(size::kStaffTarget);
  const auto in_row = page.tree.inside(row);
  const Colour ink = page.ink_of(found.mood);
  page.sign(page.sign_of(found.mood), 28, ink);
  Node both = page.grown(page.row_box(space::kM));
  both.box.wrap = true;
  page.tree.open(both);
  page.wide(page.text(tr(found.rule->words), type::kSmall, Weight::Medium, ink));
  const char* whose = page.staff.role == StaffRole::Operator ? tr("Technician") : tr("Operator");
  const std::string_view value = !mine                          ? std::string_view(whose)
                                 : found.rule->value != nullptr ? found.rule->value(page, *page.staff.status)
                                                                : std::string_view();
  if (!value.empty()) page.write(value, type::kSmall, Weight::Regular, page.palette.ink_soft, TextAlign::End);
  page.tree.close();
  if (mine) page.sign(page.onward(), 24, page.palette.link);
}

void status(StaffFrame& page) {
  const StatusView* seen = page.staff.status;
  Node card = page.box(Flow::Column, 0, space::kM, 4);
  page.card(card, size::kRadius);
  card.id = "status";
  const auto in_card = page.tree.inside(card);
  std::array<Finding, kMostFindings> room;
  const std::span<const Finding> found =
      seen != nullptr ? find_status(page.view, *seen, room) : std::span<const Finding>();
  if (!found.empty()) {
    for (const Finding& one : found) {
      if (&one != found.data()) page.rule();
      finding(page, one);
    }
  } else if (seen != nullptr && seen->looked) {
    page.status("status good", page.tr("In order"), Mood::Good);
  } else {
    page.status("status looking", page.tr("One moment, please"), Mood::Plain);
  }
}

void tile(StaffFrame& page, const StaffPageInfo& info) {
  Node node = page.grown(page.row_box(space::kS, page.portrait ? 10 : 16, 8));
  const char* title = page.tr(info.title);
  tell(node, Role::Button, info.id, title, {ActionKind::StaffOpen, int(info.page)});
  node.box.min_height = page.px(72);
  frame(node, page.palette.card, page.palette.card_border, page.px(2), page.px(20));
  const auto in_node = page.tree.inside(node);
  page.sign(info.letter, 32 / page.text_share, page.palette.accent);
  page.wide(page.text(title, type::kSmall, Weight::Medium, page.palette.ink));
}

}  // namespace

std::span<const StatusRule> status_rules() { return kRules; }

std::span<const Finding> find_status(const ViewState& view, const StatusView& status,
                                     std::array<Finding, kMostFindings>& found) {
  std::size_t count = 0;
  // What is known before the device was looked at stands there at once: its rows do not push the tiles down
  // later, away from a finger.
  StatusView known = status;
  if (!known.looked) known.free_mib = std::numeric_limits<double>::infinity();
  for (const Mood mood : {Mood::Bad, Mood::Warn}) {
    for (const StatusRule& rule : kRules) {
      if (rule.mood(view, known) == mood) found[count++] = {&rule, mood};
    }
  }
  return {found.data(), count};
}

void menu_page(StaffFrame& page) {
  page.begin(page.staff.role == StaffRole::Operator ? page.tr("Operator") : page.tr("Technician"), nullptr);
  page.tree.open(scroller("menu", page.grown(page.box(Flow::Column, space::kXs))));
  status(page);
  // Where letters are large, a long word must not be torn: fewer and wider tiles.
  const std::size_t across = page.little_room() ? 2 : 4;
  std::array<const StaffPageInfo*, std::size_t(StaffPage::Count)> tiles{};
  std::size_t count = 0;
  const auto draw = [&] {
    page.in_full_rows(std::exchange(count, 0), across, space::kS,
                      [&](std::size_t i) { tile(page, *tiles[i]); });
  };
  const char* group = nullptr;
  for (const StaffPageInfo& info : staff_pages()) {
    if (info.group != nullptr) group = info.group;
    if (!may_open(page.staff.role, info)) continue;
    if (info.page == StaffPage::Recovery && !page.staff.access.words_due) continue;  // shown once
    if (const char* title = std::exchange(group, nullptr)) {
      draw();
      page.put({}, Role::Heading, page.tr(title), type::kSmall, Weight::Bold, page.palette.link);
    }
    tiles[count++] = &info;
  }
  draw();
  page.tree.close();
  page.end();
}

}  // namespace relievo::ui

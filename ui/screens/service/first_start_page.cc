// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The first start: language, clock, consent text, both PINs; and the page on which somebody changes their
// own.
#include "ui/screens/service/pin_entry.h"

#include <array>

#include "ui/screens/service/staff_pages.h"
#include "ui/view/staff_views.h"

namespace relievo::ui {
namespace {

enum FirstStartMode : int { kWelcome, kClock, kNewPins };
constexpr const char* kClockSign = "\uf0f0";

void welcome(StaffFrame& page) {
  const auto& tr = page.tr;
  page.heading("welcome", tr("This device is new"), type::kHeading);
  page.body(
      "what",
      tr("Choose a language, check the clock and the consent text, and choose two PINs: one for the technician, one for the operator."));
  Node list = page.grown(page.box(Flow::Column, space::kS));
  list.id = "languages";
  list.box.scroll = true;
  list.box.row_stretch = page.portrait ? 1.5F : 1;
  page.tree.open(list);
  const std::size_t abreast = page.portrait ? 1 : 2;
  for (std::size_t i = 0; i < kLanguages; ++i) {
    const auto language = static_cast<Language>(i);
    const bool now = language == page.visit.language;
    if (i % abreast == 0) page.tree.open(page.box(Flow::Row, space::kS));
    page.small_button(info_of(language).code, info_of(language).own_name, now ? icon::kCheck : nullptr,
                      ButtonLook::Quiet, {ActionKind::ChooseLanguage, static_cast<int>(i)}, 1);
    if (i % abreast == abreast - 1 || i + 1 == kLanguages) page.tree.close();
  }
  page.tree.close();
  page.button("go on", tr("Go on"), page.onward(), ButtonLook::Main, {ActionKind::StaffMode, kClock});
}

void mover(StaffFrame& page, const char* label, std::string_view id, int minutes) {
  page.tree.open(page.grown(page.box(Flow::Column, space::kXs)));
  page.tree.leaf(page.text(label, type::kSmall, Weight::Medium, page.palette.ink, TextAlign::Centre));
  Node row = page.box(Flow::Row, space::kXs);
  row.box.justify = Justify::Centre;
  row.box.left_to_right = true;
  page.tree.open(row);
  const auto named = [&](std::string_view end) {
    const std::string_view first = page.tree.keep(id), second = page.tree.keep(end);
    return std::string_view{first.data(), first.size() + second.size()};
  };
  page.square_button(named(" less"), page.tr("Less"), "\uf374", Action(MoveClock{-minutes}));
  page.square_button(named(" more"), page.tr("More"), "\uf415", Action(MoveClock{minutes}));
  page.tree.close();
  page.tree.close();
}

void clock(StaffFrame& page) {
  const auto& tr = page.tr;
  page.heading("clock title", tr("Are the date and the time right?"), type::kHeading);
  Node room = page.grown(page.box(Flow::Column, space::kL));
  room.box.justify = Justify::Centre;
  room.box.scroll = true;
  room.id = "clock room";
  page.tree.open(room);
  Node time = page.text(page.date(page.staff.access.clock), type::kTitle, Weight::Bold, page.palette.ink,
                        TextAlign::Centre);
  time.id = "clock";
  time.style.size_px = page.px(type::kTitle * (1 + (page.text_share - 1) * 0.5F));  // it stays on one line
  time.role = Role::Status;
  page.tree.leaf(time);
  page.tree.open(page.box(Flow::Row, space::kM));
  mover(page, tr("Day"), "day", 24 * 60);
  mover(page, tr("Hour"), "hour", 60);
  if (page.portrait) {
    page.tree.close();
    page.tree.open(page.box(Flow::Row, space::kM));
  }
  mover(page, tr("Ten minutes"), "ten", 10);
  mover(page, tr("Minute"), "minute", 1);
  page.tree.close();
  if (page.staff.access.clock_refused)
    page.body(
        "refused",
        tr("The system does not let this program set its clock. Set it there, then start again; or go on with this one."));
  page.tree.close();
  page.button("clock right", tr("Go on"), page.onward(), ButtonLook::Main, Action(SetClock{}));
}

void consent(StaffFrame& page) {
  const auto& tr = page.tr;
  const bool own = page.view.consent != nullptr,
             busy = page.staff.consent == nullptr || page.staff.consent->taking;
  page.heading("consent title", tr("What do visitors consent to?"), type::kHeading);
  consent_in_force(page);
  page.button("consent right", own ? tr("Go on with this text") : tr("Go on with the sample"), page.onward(),
              ButtonLook::Main, busy ? Action{} : Action(ConfirmConsentText{}));
}

// In the order of PinStep.
constexpr std::array kStepTitles{
    mark_tr("Choose the technician's PIN"), mark_tr("The technician's PIN once more"),
    mark_tr("Choose the operator's PIN"),   mark_tr("The operator's PIN once more"),
    mark_tr("Choose your new PIN"),         mark_tr("Your new PIN once more"),
    mark_tr("Your PIN has been changed")};
static_assert(kStepTitles.size() == static_cast<std::size_t>(PinStep::Done) + 1);

const char* title_of(const Words& tr, PinStep step) {
  return tr(kStepTitles[static_cast<std::size_t>(step)]);
}

const char* words_of(const Words& tr, PinFault fault) {
  switch (fault) {
    case PinFault::Differ:
      return tr("The two were not the same. Choose again.");
    case PinFault::Simple:
      return tr("Too easy to guess: not one digit repeated, nothing like 1234. Choose another.");
    case PinFault::Taken:
      return tr("The other role already has this PIN. Choose another.");
    case PinFault::None:
      break;
  }
  return nullptr;
}

PinWords words_of(const Words& tr, const AccessView& access) {
  if (access.checking) return {tr("One moment, please"), {}, Mood::Plain};
  if (access.step == PinStep::Done) return {nullptr, tr("It applies from now on."), Mood::Good};
  const char* fault = words_of(tr, access.fault);
  return {tr("Four to eight digits. Nobody else should know it."),
          fault == nullptr ? std::string_view() : fault, Mood::Bad};
}

void new_pin(StaffFrame& page) {
  const AccessView& access = page.staff.access;
  const bool ready = page.service.typed().size() >= kLeastPinDigits && !access.checking;
  const bool done = access.step == PinStep::Done;
  pin_entry(page, title_of(page.tr, access.step), words_of(page.tr, access),
            ready && !done ? Action(OfferPin{}) : Action{});
}

}  // namespace

void first_start_page(StaffFrame& page) {
  if (page.staff.access.forgotten) {
    page.begin(page.tr("A PIN was forgotten"), icon::kLock);
    new_pin(page);
    return page.end();
  }
  page.begin(page.tr("First start"), kClockSign);
  if (page.service.mode == kWelcome) welcome(page);
  else if (page.service.mode == kClock && !page.staff.access.clock_right) clock(page);
  else if (page.service.mode == kClock && !page.staff.access.consent_right) consent(page);
  else new_pin(page);
  page.end();
}

void clock_page(StaffFrame& page) {
  if (page.staff.access.clock_right) page.status("clock set", page.tr("The clock was set"), Mood::Good);
  clock(page);
}

void pins_page(StaffFrame& page) { new_pin(page); }

}  // namespace relievo::ui

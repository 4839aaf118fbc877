// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The first start: language, clock, consent text, both PINs, the sheet with the recovery words. Signing in,
// the clock's page, and the page on which somebody changes their own PIN.
#include <array>

#include "ui/screens/parts/page.h"
#include "ui/screens/service/staff_frame.h"
#include "ui/view/staff_views.h"

namespace relievo::ui {

// The pages on which a PIN is typed: the way in, and choosing new ones.
namespace {

// As many dots as digits: nobody behind reads them.
void dots(StaffFrame& page, const Action& done) {
  Node row = left_first(page.row_box(14));
  tell(row, Role::Field, "typed", page.tr("Your PIN"));
  row.by_key = done;
  row.box.justify = page.portrait     ? Justify::Centre
                    : page.mirrored() ? Justify::End
                                      : Justify::Start;  // as the words above it
  row.box.height = page.px(36);
  const auto in_row = page.tree.inside(row);
  for (std::size_t i = 0; i < kMostPinDigits; ++i) {
    const bool typed = i < page.service.typed().size();
    const float across_dp = typed ? 20 : 12;
    page.tree.leaf(page.painted(page.sized(page.box(Flow::Column), across_dp, across_dp),
                                typed ? page.palette.accent : page.palette.track, 10));
  }
}

void told(StaffFrame& page, std::string_view id, std::string_view words, Mood mood) {
  page.put(id, Role::Status, words, type::kBody, Weight::Regular,
           mood == Mood::Plain ? page.palette.ink_soft : page.ink_of(mood),
           page.portrait ? TextAlign::Centre : TextAlign::Start);
}

// Words at the start, dots and digits.
struct PinWords {
  const char* hint = nullptr;  // what is asked; stands beside what is told
  std::string_view told;       // empty: nothing
  Mood mood = Mood::Plain;     // of what is told
};
PinWords words_of(StaffFrame& page) {
  const AccessView& access = page.staff.access;
  if (access.checking) return {page.tr("One moment, please"), {}, Mood::Plain};
  if (access.wait_s > 0 && !access.locked)
    return {page.tr("One moment, please"), access.wrong ? page.tr("That was not right.") : "", Mood::Bad};
  if (access.wait_s > 0)
    return {nullptr,
            page.plural_tr("Too many wrong PINs. The next try is possible in {} second.",
                           "Too many wrong PINs. The next try is possible in {} seconds.", access.wait_s),
            Mood::Bad};
  std::string_view told;
  if (access.failed) told = words_of(page.tr, *access.failed);
  else if (access.wrong) told = page.tr("That was not right.");
  return {page.tr("Type your PIN, then touch the tick."), told, Mood::Bad};
}

void pin_entry(StaffFrame& page, std::string_view title, const PinWords& words, Action done) {
  const auto in_room = page.tree.inside(centred(page.grown(page.abreast_box(space::kXl))));
  Node said = page.box(Flow::Column, space::kM);
  said.box.width = page.px(page.portrait ? 560.0F : 440.0F);
  page.tree.open(said);
  const TextAlign align = page.portrait ? TextAlign::Centre : TextAlign::Start;
  page.heading("pin title", title, type::kHeading, align);
  if (words.hint != nullptr) told(page, "pin hint", words.hint, Mood::Plain);
  if (!words.told.empty()) told(page, "pin state", words.told, words.mood);
  dots(page, done);
  page.tree.close();
  number_pad(page, {"digit ", "pin done"}, done);
}

enum FirstStartMode : int { kWelcome, kClock, kNewPins };
constexpr const char* kClockSign = "\uf0f0";

void welcome(StaffFrame& page) {
  const auto& tr = page.tr;
  page.heading("welcome", tr("Choose your language"), type::kHeading);
  page.body(
      "what",
      tr("Choose a language, check the clock and the consent text, and choose two PINs: one for the technician, one for the operator."));
  Node list = scroller("languages", page.grown(page.box(Flow::Column, space::kS)));
  list.box.row_stretch = page.portrait ? 1.5F : 1;
  page.tree.open(list);
  page.in_rows(kLanguages, page.portrait ? 1 : 2, space::kS, [&](std::size_t i) {
    const auto language = static_cast<Language>(i);
    const bool now = language == page.visit.language;
    page.small_button(info_of(language).code, info_of(language).own_name, now ? icon::kCheck : nullptr,
                      ButtonLook::Quiet, {ActionKind::ChooseLanguage, int(i)}, 1);
  });
  page.tree.close();
  Action on(ChooseHome{page.visit.language}, true);
  on.value = kClock;
  page.button("go on", tr("Go on"), page.onward(), ButtonLook::Main, on);
}

void mover(StaffFrame& page, std::string_view label, std::string_view id, int minutes) {
  page.tree.open(page.grown(page.box(Flow::Column, space::kXs)));
  page.write(label, type::kSmall, Weight::Medium, page.palette.ink, TextAlign::Centre);
  page.tree.open(left_first(justified(page.box(Flow::Row, space::kXs), Justify::Centre)));
  page.square_button(page.joined({id, " less"}), page.tr("Less"), icon::kLess, MoveClock{-minutes}, label);
  page.square_button(page.joined({id, " more"}), page.tr("More"), icon::kMore, MoveClock{minutes}, label);
  page.tree.close(2);
}

void clock(StaffFrame& page) {
  const auto& tr = page.tr;
  page.heading("clock title", tr("Are the date and the time right?"), type::kHeading);
  page.tree.open(
      scroller("clock room", justified(page.grown(page.box(Flow::Column, space::kL)), Justify::Centre)));
  Node time = page.text(page.date(page.staff.access.clock), type::kTitle, Weight::Bold, page.palette.ink,
                        TextAlign::Centre);
  time.style.size_px = page.px(type::kTitle * (1 + (page.text_share - 1) * 0.5F));  // it stays on one line
  page.put("clock", Role::Status, time);
  // From coarse to fine, from the left as the figures above in every language. A clock whose battery is dead
  // has years to go.
  constexpr int kDay = 24 * 60;
  page.tree.open(left_first(page.box(Flow::Row, space::kM)));
  mover(page, page.days(365), "year", 365 * kDay);
  mover(page, page.days(30), "month", 30 * kDay);
  mover(page, tr("Day"), "day", kDay);
  if (page.little_room()) {
    page.tree.close();
    page.tree.open(left_first(page.box(Flow::Row, space::kM)));
  }
  mover(page, tr("Hour"), "hour", 60);
  mover(page, tr("Ten minutes"), "ten", 10);
  mover(page, tr("Minute"), "minute", 1);
  page.tree.close();
  if (page.staff.access.clock_refused)
    page.body(
        "refused",
        tr("The system does not let this program set its clock. Set it there, then start again; or go on with this one."));
  page.tree.close();
  page.button("clock right", tr("Go on"), page.onward(), ButtonLook::Main, SetClock{});
}

void consent(StaffFrame& page) {
  const auto& tr = page.tr;
  const bool busy = page.staff.consent == nullptr || page.staff.consent->taking;
  page.heading("consent title", tr("Consent text"), type::kHeading);
  consent_in_force(page);
  page.button("consent right", tr("Go on"), page.onward(), ButtonLook::Main,
              busy ? Action{} : ConfirmConsentText{});
}

std::string_view title_of(StaffFrame& page, PinStep step) {
  const auto& tr = page.tr;
  if (step == PinStep::Done) return tr("Change my PIN");
  const bool again =
      step == PinStep::TechnicianAgain || step == PinStep::OperatorAgain || step == PinStep::OwnAgain;
  const char* what = again ? tr("The PIN once more") : tr("Choose a PIN");
  if (step >= PinStep::Own) return what;
  return page.filled("{} – {}", {step < PinStep::Operator ? tr("Technician") : tr("Operator"), what});
}

// In the order of PinFault.
constexpr std::array<const char*, 4> kPinFaults{
    "", mark_tr("The two were not the same. Choose again."),
    mark_tr("Too easy to guess: not one digit repeated, nothing like 1234. Choose another."),
    mark_tr("The other role already has this PIN. Choose another.")};
static_assert(kPinFaults.size() == std::size_t(PinFault::Taken) + 1);

PinWords words_of(const Words& tr, const AccessView& access) {
  if (access.checking) return {tr("One moment, please"), {}, Mood::Plain};
  if (access.step == PinStep::Done) return {nullptr, tr("It applies from now on."), Mood::Good};
  const bool fault = access.fault != PinFault::None;
  return {tr("Four to eight digits. Nobody else should know it."),
          access.failed ? words_of(tr, *access.failed)
          : fault       ? one_of(tr, kPinFaults, access.fault)
                        : "",
          Mood::Bad};
}

enum RecoveryMode : int { kSheet, kTypeWord };

void word(StaffFrame& page, const RecoveryView& seen, std::size_t i) {
  // English, and in this order.
  const auto in_row = page.tree.inside(left_first(page.grown(page.row_box(space::kS))));
  Node number =
      page.text(page.number(i + 1), type::kSmall, Weight::Regular, page.palette.ink_soft, TextAlign::End);
  number.box.width = page.px(36 * page.text_share);
  page.tree.leaf(number);
  Node said = page.english(seen.words[i], type::kBody);
  said.colour = page.palette.ink;
  page.tree.leaf(said);
}

// Downwards in columns, as the sheet is written.
void words(StaffFrame& page, const RecoveryView& seen) {
  const std::size_t columns = page.large_words() ? 2 : 3, rows = seen.words.size() / columns;
  Node card = left_first(page.box(Flow::Row, space::kM, space::kM, space::kM));
  page.card(card, size::kRadius);
  card.id = "words";
  const auto in_card = page.tree.inside(card);
  for (std::size_t c = 0; c < columns; ++c) {
    const auto in_box = page.tree.inside(page.grown(page.box(Flow::Column, space::kXs)));
    for (std::size_t r = 0; r < rows; ++r) word(page, seen, c * rows + r);
  }
}

void sheet(StaffFrame& page, const RecoveryView& seen) {
  page.tree.open(centred(page.grown(page.abreast_box(space::kL))));
  page.tree.open(page.grown(page.box(Flow::Column, space::kM), page.portrait ? 0.0F : 1.0F));
  page.body(
      "what",
      page.tr(
          "Write these words down in this order. They open the records should this device break; whoever has them and its disk can read every record."));
  words(page, seen);
  page.tree.close();
  Node code = page.sized(page.box(Flow::Column), 260, 260);
  tell(code, Role::Picture, "code", page.tr("Recovery words"));
  depict(code, PictureSlot::TechnicianLeft);
  page.tree.leaf(code);
  page.tree.close();
  page.button("written", page.tr("Go on"), page.onward(), ButtonLook::Main,
              {ActionKind::StaffMode, kTypeWord});
}

void typing(StaffFrame& page, const RecoveryView& seen) {
  const bool busy = seen.state == SheetState::Saving;
  const std::string_view typed = page.service.typed();
  const Action done = typed.empty() || busy ? Action{} : OfferWord{};
  page.typed_field("word field", page.filled(page.tr("Word {} of the sheet"), page.number(seen.asked)), done);
  if (busy) page.status("state", page.tr("One moment, please"), Mood::Plain);
  if (seen.state == SheetState::Wrong && typed.empty())
    page.status("state", page.tr("That was not right."), Mood::Bad);
  if (seen.state == SheetState::Failed) page.outcome();
  if (page.portrait) page.space(1);
  keyboard(page, done, Language::English);
}

}  // namespace

void pin_page(StaffFrame& page) {
  page.begin(page.tr("Staff"), icon::kLock);
  const AccessView& access = page.staff.access;
  const bool ready = page.service.typed().size() >= kLeastPinDigits && !access.checking && access.wait_s == 0;
  pin_entry(page, page.tr("Your PIN"), words_of(page), ready ? CheckPin{} : Action{});
  page.end();
}

void pins_page(StaffFrame& page) {
  const AccessView& access = page.staff.access;
  const bool ready =
      page.service.typed().size() >= kLeastPinDigits && !access.checking && access.step != PinStep::Done;
  pin_entry(page, title_of(page, access.step), words_of(page.tr, access), ready ? OfferPin{} : Action{});
}

void first_start_page(StaffFrame& page) {
  if (page.staff.access.forgotten) {
    page.begin(page.tr("Staff"), icon::kLock);
    pins_page(page);
    return page.end();
  }
  page.begin(page.tr("First start"), kClockSign);
  if (page.service.mode == kWelcome) welcome(page);
  else if (page.service.mode == kClock && !page.staff.access.clock_right) clock(page);
  else if (page.service.mode == kClock && !page.staff.access.consent_right) consent(page);
  else pins_page(page);
  page.end();
}

void clock_page(StaffFrame& page) {
  if (page.staff.access.clock_right) page.status("clock set", page.tr("The clock was set"), Mood::Good);
  clock(page);
}

// The recovery sheet: twelve words and the same as a QR code, to be written down; then two of them are typed.
void recovery_page(StaffFrame& page) {
  const RecoveryView* seen = page.staff.recovery;
  if (seen == nullptr) return page.body("wait", page.tr("One moment, please"));
  if (seen->state == SheetState::Done) {
    page.status("state", page.tr("It applies from now on."), Mood::Good);
    page.space(1);
    return page.button("go on", page.tr("Go on"), page.onward(), ButtonLook::Main,
                       {ActionKind::StaffOpen, int(StaffPage::Menu)});
  }
  if (page.service.mode == kTypeWord) typing(page, *seen);
  else sheet(page, *seen);
}

}  // namespace relievo::ui

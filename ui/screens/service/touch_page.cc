// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The page of settings; and the touch screen's correction: crosses to be touched, what came of it.
#include "ui/device/settings.h"
#include "ui/device/touch_map.h"
#include "ui/screens/service/staff_frame.h"

namespace relievo::ui {

// What the staff may choose about the device, a row each: less, the value, more.
namespace {

void chooser(StaffFrame& page, const Settings& settings, Setting setting) {
  const SettingInfo& info = info_of(setting);
  const auto ask = [&](bool more) {
    const bool end = settings.beside(setting, more ? 1 : -1) == settings.of(setting);
    return end ? Action{} : ChangeSetting{setting, more};
  };
  page.stepper(info.key, name_of(page.tr, setting), said_value(page, setting, settings.of(setting)),
               ask(false), ask(true));
}

void group(StaffFrame& page, const char* title, std::span<const Setting> settings) {
  const bool technician = page.staff.role == StaffRole::Technician;
  bool titled = false;
  for (const Setting setting : settings) {
    const SettingInfo& info = info_of(setting);
    if (!(technician ? info.for_technician : info.for_operator)) continue;
    if (!titled) page.section(title);
    titled = true;
    chooser(page, page.staff.settings->settings, setting);
  }
}

void said(StaffFrame& page) {
  if (page.staff.work.outcome != Outcome::Done) return page.outcome();
  page.status("outcome", page.tr("It applies from now on."), Mood::Good);
}

constexpr const char* kCross = "\uf1a3";

// In the order of TouchVerdict.
constexpr std::array<Told, 7> kTold{
    {{nullptr, Mood::Plain},
     {mark_tr("It applies from now on."), Mood::Good},
     {mark_tr("The touch screen is taken as it is."), Mood::Good},
     {mark_tr("Nothing was changed."), Mood::Warn},
     {mark_tr(
          "The touches do not fit together. Nothing has changed: try again, with one finger, in the middle of each cross."),
      Mood::Bad},
     {mark_tr("The test cross was missed. Nothing has changed: try again."), Mood::Bad},
     {mark_tr("It could not be done. The log says why."), Mood::Bad}}};
static_assert(kTold.size() == std::size_t(TouchVerdict::NotSaved) + 1);

// One cross in its place; what is to be done, in the middle.
void crosses(StaffFrame& page, const TouchView& seen) {
  Node room = page.grown(page.box(Flow::Stack));
  room.id = "crosses";
  const auto in_room = page.tree.inside(room);
  Node middle = pinned(page.box(Flow::Column, space::kS), 0.5F, 0.5F);
  middle.box.width = page.px(page.portrait ? 480.0F : 640.0F);
  middle.box.height = page.px(220 * page.text_share);
  page.tree.open(middle);
  const bool test = seen.step == TouchStep::Test;
  page.heading("cross words", page.tr("Touch the middle of the cross"), type::kHeading, TextAlign::Centre);
  page.body("cross wait",
            page.plural_tr("In {} second everything goes back to what it was.",
                           "In {} seconds everything goes back to what it was.", seen.seconds_left),
            TextAlign::Centre);
  page.tree.close();
  const TouchPoint& at = kTouchCrosses[seen.cross];
  Node cross = pinned(centred(page.sized(page.box(Flow::Row), 84, 84)), at.x, at.y);
  tell(cross, Role::Status, "cross", page.tr("Touch the middle of the cross"));
  const auto in_cross = page.tree.inside(cross);
  page.sign(kCross, 72 / page.text_share, test ? page.palette.good : page.palette.accent);
}

void figures(StaffFrame& page, const TouchView& seen) {
  const auto& tr = page.tr;
  page.begin_list("touch");
  page.row("corrected", tr("Correction"), seen.corrected ? tr("yes") : tr("no"));
  if (seen.fit) {
    page.row("turned", tr("The panel is turned by"), page.number(seen.fit->turned_deg, 1, "°"));
    page.row("mirrored", tr("Mirrored"), seen.fit->mirrored ? tr("yes") : tr("no"));
    page.row("off", tr("The crosses were hit to within"), page.number(seen.fit->off * 100, 2, "%"),
             seen.fit->off <= kMostTouchOff ? Mood::Good : Mood::Bad);
  }
  page.line(tr(
      "Four crosses, then one to test: anything changes only if that one is hit. A keypad and a mouse always work."));
  page.tree.close();
}

}  // namespace

void settings_page(StaffFrame& page) {
  const auto& tr = page.tr;
  if (page.staff.settings == nullptr) return page.body("wait", tr("One moment, please"));
  said(page);
  page.begin_list("settings");
  group(page, tr("How a visit begins"),
        std::array{Setting::Language, Setting::TextPercent, Setting::Contrast});
  group(page, tr("Waiting"), std::array{Setting::PatienceS, Setting::StaffPatienceS});
  group(page, tr("Pictures"),
        std::array{Setting::Automatic, Setting::CountdownMs, Setting::Sides, Setting::Attempts});
  group(page, tr("Records"), std::array{Setting::TellsKnown, Setting::KeepDays, Setting::LeastRoomMib});
  if (page.staff.role == StaffRole::Operator && page.staff.settings->settings.is_on(Setting::KeepDays))
    page.line(tr(
        "Counted from the newest consent. What is older is erased once a day, while nobody is at the screen."));
  if (page.staff.role == StaffRole::Operator) {
    page.section(tr("Consent"));
    const ConsentTexts* own = page.view.consent;
    page.row("consent", tr("Consent text"), own != nullptr ? std::string_view(own->version) : kConsentWording,
             own != nullptr ? Mood::Plain : Mood::Warn, {ActionKind::StaffOpen, int(StaffPage::Consent)});
  }
  group(page, tr("Export to the stick"), std::array{Setting::Solids, Setting::TakeHome});
  group(page, tr("What is heard and what moves"), std::array{Setting::Sounds, Setting::Motion});
  if (page.staff.settings->clock_jumped)
    page.line(
        tr("The clock has jumped ahead: nothing is erased. Check the clock, then choose the time again."),
        Mood::Warn);
  page.tree.close();
}

void touch_page(StaffFrame& page) {
  const auto& tr = page.tr;
  const TouchView* seen = page.staff.touch;
  if (seen == nullptr) return page.body("wait", tr("One moment, please"));
  if (seen->step != TouchStep::Rest) return crosses(page, *seen);
  const Told& told = kTold[std::size_t(seen->verdict)];
  if (told.words != nullptr) page.status("verdict", tr(told.words), told.mood);
  figures(page, *seen);
  const bool upright = page.little_room();
  const auto in_box = page.tree.inside(page.box(upright ? Flow::Column : Flow::Row, space::kS));
  page.small_button("begin", tr("Start"), kCross, ButtonLook::Main, BeginTouchTrial{});
  if (seen->corrected)
    page.small_button("plain", tr("Default"), nullptr, ButtonLook::Quiet, TakePlainTouch{});
}

}  // namespace relievo::ui

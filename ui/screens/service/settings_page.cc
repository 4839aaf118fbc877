// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the staff may choose about the device, a row each: less, the value, more.
#include "ui/device/settings.h"

#include "ui/screens/service/setting_words.h"
#include "ui/screens/service/staff_pages.h"

namespace relievo::ui {
namespace {

void chooser(StaffFrame& page, const Settings& settings, Setting setting) {
  const SettingInfo& info = info_of(setting);
  const auto ask = [&](bool more) {
    const bool end = settings.beside(setting, more ? 1 : -1) == settings.of(setting);
    return end ? Action{} : Action(ChangeSetting{setting, more});
  };
  page.stepper(info.key, name_of(page.tr, setting), said_value(page, setting, settings.of(setting)),
               icon::kLess, ask(false), icon::kMore, ask(true));
}

void group(StaffFrame& page, const char* title, std::span<const Setting> settings) {
  const bool technician = page.staff.role == StaffRole::Technician;
  bool titled = false;
  for (const Setting setting : settings) {
    const SettingInfo& info = info_of(setting);
    if (!(technician ? info.technician : info.clerk)) continue;
    if (!titled) page.section(title);
    titled = true;
    chooser(page, page.staff.settings->settings, setting);
  }
}

void said(StaffFrame& page) {
  if (page.staff.work.outcome != Outcome::Done) return page.outcome();
  page.status("outcome", page.tr("It applies from now on."), Mood::Good);
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
    page.row("consent", tr("Consent text"),
             own != nullptr ? std::string_view(own->version) : tr("our sample, not reviewed"),
             own != nullptr ? Mood::Plain : Mood::Warn,
             {ActionKind::StaffOpen, static_cast<int>(StaffPage::Consent)});
  }
  group(page, tr("Export to the stick"), std::array{Setting::Solids});
  group(page, tr("What is heard and what moves"), std::array{Setting::Sounds, Setting::Motion});
  if (page.staff.settings->clock_jumped)
    page.line(
        tr("The clock has jumped ahead: nothing is erased. Check the clock, then choose the time again."),
        Mood::Warn);
  page.tree.close();
}

}  // namespace relievo::ui

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/page/settings_desk.h"

namespace relievo::firmware {

void SettingsDesk::opened() { outcome_ = ui::Outcome::None; }

void SettingsDesk::ask(const ui::StaffWish& wish) {
  if ((wish.verb != ui::kSettingLess && wish.verb != ui::kSettingMore) || wish.number < 0 ||
      wish.number >= static_cast<std::int64_t>(ui::kSettings))
    return;
  const auto setting = static_cast<ui::Setting>(wish.number);
  const ui::SettingInfo& info = info_of(setting);
  if (!(tools().role == ui::StaffRole::Technician ? info.technician : info.clerk)) return;
  const std::int32_t value =
      tools().settings.wanted().beside(setting, wish.verb == ui::kSettingMore ? 1 : -1);
  tools().settings.change(setting, value, [this](const std::optional<Error>& error) {
    outcome_ = error ? outcome_of(*error) : ui::Outcome::Done;
  });
  if (setting == ui::Setting::KeepDays) tools().retention.begin_anew();
}

void SettingsDesk::show(ui::ServiceView& view) {
  view.work.outcome = outcome_;
  view_ = {tools().settings.wanted(), tools().retention.clock_jumped()};
  view.settings = &view_;
}

}  // namespace relievo::firmware

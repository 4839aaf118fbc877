// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/page/settings_controller.h"

namespace relievo::firmware {

void SettingsController::opened() { outcome_ = ui::Outcome::None; }

void SettingsController::ask(const ui::StaffRequest& request) {
  const auto* asked = request.as<ui::ChangeSetting>();
  if (asked == nullptr) return;
  const ui::Setting setting = asked->setting;
  const ui::SettingInfo& info = info_of(setting);
  if (!(services().role == ui::StaffRole::Technician ? info.technician : info.clerk)) return;
  const std::int32_t value = services().settings.wanted().beside(setting, asked->more ? 1 : -1);
  services().settings.change(setting, value, [this](const std::optional<Error>& error) {
    outcome_ = error ? outcome_of(*error) : ui::Outcome::Done;
  });
  if (setting == ui::Setting::KeepDays) services().retention.begin_anew();
}

void SettingsController::show(ui::ServiceView& view) {
  view.work.outcome = outcome_;
  view_ = {services().settings.wanted(), services().retention.clock_jumped()};
  view.settings = &view_;
}

}  // namespace relievo::firmware

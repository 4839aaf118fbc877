// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/device_settings.h"

#include <utility>

#include "firmware/service/retention.h"

namespace relievo::firmware {

Result<void> DeviceSettings::look() {
  RELIEVO_TRY_ASSIGN(const std::string kept, store_.setting(kDeviceSetting));
  std::vector<std::string> complaints;
  now_ = wanted_ = settings_of(kept, complaints);
  for (const std::string& complaint : complaints) log_.say(ui::LogEvent::SettingUnknown, {complaint});
  return {};
}

bool DeviceSettings::change(ui::Setting setting, std::int32_t value, Done done) {
  ui::Settings next = wanted_;
  if (!next.set(setting, value)) return false;
  wanted_ = next;
  asked_.emplace_back(setting, value);
  side_tasks_.send(
      JobLane::Keeper,
      // now_ does not change while this runs: the keeper begins one when the one before it has been heard.
      [this, setting, value](JobControl&) -> Result<void> {
        // Whoever chooses how long records are kept has looked at the clock.
        if (setting == ui::Setting::KeepDays)
          RELIEVO_TRY(trust_clock(store_, std::chrono::floor<std::chrono::milliseconds>(clock_.wall_now())));
        ui::Settings written = now_;  // without those before it that could not be written
        written.set(setting, value);
        return store_.set_setting(kDeviceSetting, text_of(written));
      },
      [this, setting, value, done = std::move(done)](const std::optional<Error>& error) {
        asked_.erase(asked_.begin());
        if (error) {
          log_.fault(*error);
        } else {
          now_.set(setting, value);
          log_.say(ui::LogEvent::SettingChanged, {info_of(setting).key, std::to_string(value)});
        }
        wanted_ = now_;
        for (const auto& [waiting, its_value] : asked_) wanted_.set(waiting, its_value);
        done(error);
      },
      SideTasks::Whose::Device);
  return true;
}

}  // namespace relievo::firmware

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/device_settings.h"

#include <charconv>
#include <memory>
#include <string>

#include "firmware/base/wall_time.h"
#include "firmware/service/record_filter.h"

namespace relievo::firmware {
namespace {

using storage::WallTime;

constexpr std::chrono::hours kEvery{24};

Result<WallTime> clock_seen(storage::Store& store) {
  RELIEVO_TRY_ASSIGN(const std::string kept, store.setting(kClockSeenSetting));
  std::int64_t seen_ms = 0;  // nobody has said that it is right
  std::from_chars(kept.data(), kept.data() + kept.size(), seen_ms);
  return WallTime(std::chrono::milliseconds(seen_ms));
}

}  // namespace

Result<void> trust_clock(storage::Store& store, WallTime now) {
  return store.set_setting(kClockSeenSetting, std::to_string(now.time_since_epoch().count()));
}

Result<void> erase_person(storage::Store& store, storage::SubjectId id, EventLog& log) {
  const Result<void> erased = store.erase_subject(id);
  if (erased || erased.error().code == Errc::NotFound) return erased;
  const auto left = store.subject(id);
  if (left || left.error().code != Errc::NotFound) return erased;
  if (erased.error().code != Errc::Timeout) log.fault(erased.error());
  return {};
}

Result<void> erase_expired(storage::Store& store, WallTime now, int keep_days, EventLog& log,
                           JobControl& control, int& erased) {
  if (keep_days <= 0) return {};
  RELIEVO_TRY_ASSIGN(const WallTime seen, clock_seen(store));
  if (now > seen + kMostLeap)
    return Error{
        Errc::InvalidState,
        "the clock is far ahead of when it was last seen: nothing is erased by age until the operator has chosen the time again"};
  std::vector<storage::SubjectId> expired;
  const WallTime before = now - std::chrono::days(keep_days);
  RELIEVO_TRY(for_each_record(store, storage::Store::Opened::NamesAndConsents, control,
                              [&](const storage::Subject& subject, const storage::Consent* newest) {
                                if ((newest != nullptr ? newest->given_at : subject.created_at) < before)
                                  expired.push_back(subject.id);
                              }));
  for (const storage::SubjectId id : expired) {
    if (control.cancelled.load()) return Error{Errc::Cancelled, "the rest is erased later"};
    const Result<void> gone = erase_person(store, id, log);
    if (!gone && gone.error().code != Errc::NotFound) return gone.error();
    ++erased;
  }
  // A clock that was set back for a while would seem to have jumped when it is right again.
  return now > seen ? trust_clock(store, now) : Result<void>();
}

void RetentionWatch::turn(const ui::Settings& settings) {
  const int days = settings.of(ui::Setting::KeepDays);
  if (days == 0 || clock_.now() < next_ || side_tasks_.busy(JobLane::Keeper)) return;
  next_ = clock_.now() + kEvery;
  const auto erased = std::make_shared<int>(0);
  side_tasks_.send(
      JobLane::Keeper,
      [this, erased, days](JobControl& control) -> Result<void> {
        return erase_expired(store_, stored_time(clock_.wall_now()), days, log_, control, *erased);
      },
      [this, erased](const std::optional<Error>& error) {
        if (error && error->code == Errc::Cancelled) next_ = {};  // a visitor came in between
        else if (error) log_.fault(*error);
        jumped_ = error && error->code == Errc::InvalidState;
        if (*erased > 0) log_.say(ui::LogEvent::RecordsExpired, {std::to_string(*erased)});
      },
      SideTasks::Whose::Device);
}

Result<void> DeviceSettings::look() {
  RELIEVO_TRY_ASSIGN(const std::string kept, store_.setting(kDeviceSetting));
  std::vector<std::string> complaints;
  now_ = wanted_ = settings_of(kept, complaints);
  for (const std::string& complaint : complaints) log_.say(ui::LogEvent::SettingUnknown, {complaint});
  return {};
}

void DeviceSettings::change(ui::Setting setting, std::int32_t value, Done done) {
  ui::Settings next = wanted_;
  if (!next.set(setting, value)) return;
  wanted_ = next;
  asked_.emplace_back(setting, value);
  side_tasks_.send(
      JobLane::Keeper,
      // now_ does not change while this runs: the keeper begins one when the one before it has been heard.
      [this, setting, value](JobControl&) -> Result<void> {
        // Whoever chooses how long records are kept has looked at the clock.
        if (setting == ui::Setting::KeepDays)
          RELIEVO_TRY(trust_clock(store_, stored_time(clock_.wall_now())));
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
}

}  // namespace relievo::firmware

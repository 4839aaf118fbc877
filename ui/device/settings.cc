// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/device/settings.h"

#include <algorithm>

#include "ui/language/language.h"

namespace relievo::ui {
namespace {

// Places in ui::Language: new languages come last.
constexpr std::array<std::int32_t, 8> kEveryLanguage{0, 1, 2, 3, 4, 5, 6, 7};
static_assert(kEveryLanguage.size() == kLanguages);
constexpr std::array<std::int32_t, 2> kSwitch{0, 1};
constexpr std::array<std::int32_t, 4> kText{100, 125, 150, 200};
// WCAG 2.2.1 wants no less than 20 s to answer; the question comes after this, and waits for kLastCall more.
constexpr std::array<std::int32_t, 7> kPatience{20, 30, 45, 60, 90, 120, kMostPatienceS};
constexpr std::array<std::int32_t, 5> kCountdowns{1000, 1500, 2000, 3000, 5000};
constexpr std::array<std::int32_t, 5> kAttempts{1, 2, 3, 4, 5};
constexpr std::array<std::int32_t, 6> kStaffPatience{30, 60, 120, 180, 240, kMostStaffPatienceS};
// From the longest: whoever goes through them passes no shorter time than the one they want.
constexpr std::array<std::int32_t, 9> kDays{0, 1825, 1095, 730, 365, 180, 90, 30, 7};
constexpr std::array<std::int32_t, 6> kRoom{256, 512, 1024, 2048, 4096, 8192};

constexpr std::array<SettingInfo, kSettings> kInfos{{
    {Setting::Language, "language", kEveryLanguage, 0, true, true},
    {Setting::TextPercent, "text_percent", kText, 100, true, true},
    {Setting::Contrast, "high_contrast", kSwitch, 0, true, true},
    {Setting::Motion, "motion", kSwitch, 1, true, true},
    {Setting::PatienceS, "patience_s", kPatience, 45, true, true},
    {Setting::Automatic, "automatic_shot", kSwitch, 1, true, false},
    {Setting::CountdownMs, "countdown_ms", kCountdowns, 1500, true, false},
    {Setting::Sides, "sides", kSwitch, 1, true, false},
    {Setting::Attempts, "attempts", kAttempts, 3, true, false},
    {Setting::StaffPatienceS, "staff_patience_s", kStaffPatience, 120, true, false},
    {Setting::TellsKnown, "tells_known", kSwitch, 1, false, true},
    {Setting::KeepDays, "keep_days", kDays, 0, false, true},
    {Setting::Solids, "solids", kSwitch, 0, false, true},
    {Setting::Sounds, "sounds", kSwitch, 1, true, true},
    {Setting::LeastRoomMib, "least_room_mib", kRoom, 512, true, false},
    // Off: it is the operator who opens a port to strangers, and lets a face go unsealed.
    {Setting::TakeHome, "take_home", kSwitch, 0, false, true},
}};
static_assert([] {
  for (std::size_t i = 0; i < kSettings; ++i)
    if (kInfos[i].setting != Setting(i)) return false;
  return true;
}());

}  // namespace

const SettingInfo& info_of(Setting setting) { return kInfos[std::size_t(setting)]; }

Settings::Settings() {
  for (const SettingInfo& info : kInfos) values_[std::size_t(info.setting)] = info.usual;
}

bool Settings::set(Setting setting, std::int32_t value) {
  if (setting >= Setting::Count) return false;
  const auto& values = info_of(setting).values;
  if (std::ranges::find(values, value) == values.end()) return false;
  values_[std::size_t(setting)] = value;
  return true;
}

std::int32_t Settings::beside(Setting setting, int step) const {
  const auto& values = info_of(setting).values;
  const auto at = std::ranges::find(values, of(setting)) - values.begin() + step;
  return values[std::size_t(std::clamp<std::ptrdiff_t>(at, 0, std::ssize(values) - 1))];
}

}  // namespace relievo::ui

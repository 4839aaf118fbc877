// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/screens/service/setting_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>

namespace relievo::ui {
namespace {

std::string_view days(StaffFrame& page, std::int32_t value) {
  if (value == 0) return page.tr("never");
  char text[16];
  std::snprintf(text, sizeof text, "%d", value);
  return page.filled(page.tr.plural("{} day", "{} days", static_cast<unsigned long>(value)), text);
}

// In the order of Setting.
constexpr std::array kSettingNames{mark_tr("Language in which a visit begins"),
                                   mark_tr("Size of the text"),
                                   mark_tr("More contrast"),
                                   mark_tr("Pictures that move by themselves"),
                                   mark_tr("Visitors are asked whether they are still there after"),
                                   mark_tr("The picture is taken by itself"),
                                   mark_tr("Countdown before the picture"),
                                   mark_tr("Pictures of the sides of the head"),
                                   mark_tr("Tries, if a picture is refused"),
                                   mark_tr("Staff are signed out after"),
                                   mark_tr("Visitors are told that their name is already in the records"),
                                   mark_tr("Records are erased by themselves after"),
                                   mark_tr("A solid for printing with each exported portrait"),
                                   mark_tr("Quiet sounds for the countdown, the shutter and success"),
                                   mark_tr("Room kept free on the disk")};
static_assert(kSettingNames.size() == static_cast<std::size_t>(Setting::Count));

}  // namespace

const char* name_of(const Words& tr, Setting setting) {
  return tr(kSettingNames[static_cast<std::size_t>(setting)]);
}

std::string_view said_value(StaffFrame& page, Setting setting, std::int32_t value) {
  switch (setting) {
    case Setting::Language:
      return info_of(static_cast<Language>(value)).own_name;
    case Setting::Contrast:
    case Setting::Motion:
    case Setting::Automatic:
    case Setting::Sides:
    case Setting::Solids:
    case Setting::Sounds:
    case Setting::TellsKnown:
      return value != 0 ? page.tr("yes") : page.tr("no");
    case Setting::TextPercent:
      return page.number(value, 0, "%");
    case Setting::PatienceS:
    case Setting::StaffPatienceS:
      return page.number(value, 0, "s");
    case Setting::CountdownMs:
      return page.number(value * 1e-3, 1, "s");
    case Setting::KeepDays:
      return days(page, value);
    case Setting::LeastRoomMib:
      return page.number(value, 0, "MiB");
    case Setting::Attempts:
    case Setting::Count:
      break;
  }
  return page.number(value);
}

std::string_view said_change(StaffFrame& page, std::string_view key, std::string_view value) {
  std::int32_t figure = 0;
  if (std::from_chars(value.data(), value.data() + value.size(), figure).ptr != value.data() + value.size())
    return {};
  for (std::size_t i = 0; i < kSettings; ++i) {
    const auto setting = static_cast<Setting>(i);
    const SettingInfo& info = info_of(setting);
    if (info.key != key) continue;
    if (std::find(info.values.begin(), info.values.end(), figure) == info.values.end()) return {};
    return page.filled(page.tr("Setting “{}”: {}"),
                       {name_of(page.tr, setting), said_value(page, setting, figure)});
  }
  return {};
}

}  // namespace relievo::ui

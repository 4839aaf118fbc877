// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Settings: what the staff may choose about the device, as plain data. Each setting is a row of one table:
// its key on the disk, the values it can have, who may choose it. A value that is none of them cannot be set,
// so whoever reads one need not check it. Everything holds at once; how a visit begins (language, text,
// contrast) holds from the next visit on. Thread: any, as plain data. Errors: set() says false.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace relievo::ui {

enum class Setting : std::uint8_t {
  Language,  // a Language: in which a visit begins
  TextPercent,
  Contrast,
  Motion,          // what moves by itself: the head that invites, the portrait that turns
  PatienceS,       // without a touch, until a visitor is asked whether they are there
  Automatic,       // the picture is taken by itself
  CountdownMs,     // before it is
  Sides,           // after the frontal picture the head is turned and photographed from its sides
  Attempts,        // refused captures, until a person is asked to come again
  StaffPatienceS,  // without a touch, until staff are signed out
  TellsKnown,      // is a visitor told that their name is in the records already?
  KeepDays,        // since the last consent; 0: until somebody erases it
  Solids,          // a solid for printing stands beside each portrait that is exported
  Sounds,          // ticks of the countdown, shutter, done; who listens to the pages hears them always
  LeastRoomMib,    // so much of the disk stays free: a portrait that would need it is not stored
  TakeHome,        // may visitors have a copy of their portrait on a stick of their own?
  Count
};
inline constexpr std::size_t kSettings = std::size_t(Setting::Count);

// The largest of PatienceS and of StaffPatienceS.
inline constexpr std::int32_t kMostPatienceS = 180, kMostStaffPatienceS = 300;

struct SettingInfo {
  Setting setting;
  std::string_view key;
  std::span<const std::int32_t> values;  // in the order in which Less and More go through them
  std::int32_t usual;                    // one of them
  bool for_technician, for_operator;     // who may choose it
};
const SettingInfo& info_of(Setting setting);

class Settings {
 public:
  Settings();
  std::int32_t of(Setting setting) const { return values_[std::size_t(setting)]; }
  bool is_on(Setting setting) const { return of(setting) != 0; }
  bool set(Setting setting, std::int32_t value);
  // The value before (-1) or after (+1); the present one where there is none.
  std::int32_t beside(Setting setting, int step) const;
  bool operator==(const Settings&) const = default;

 private:
  std::array<std::int32_t, kSettings> values_{};
};

struct SettingsView {
  Settings settings;          // as they will be: what is being saved is shown already
  bool clock_jumped = false;  // nothing is erased by age until KeepDays is chosen anew
};

}  // namespace relievo::ui

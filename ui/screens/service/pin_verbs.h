// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the pages with PINs ask: the verbs of StaffPage::Pin, FirstStart and Pins, and what they share.
#pragma once

#include <cstdint>

#include "ui/screens/service/staff_frame.h"

namespace relievo::ui {

inline constexpr std::uint8_t kPinCheck = 1;  // text: the PIN
// FirstStart, Pins: text: the PIN. It is typed twice; what the appliance makes of it is ServiceView::pins.
inline constexpr std::uint8_t kPinOffer = 2;
inline constexpr std::uint8_t kClockMove = 3;  // FirstStart: number: minutes to add to the shown time
inline constexpr std::uint8_t kClockSet = 4;   // FirstStart: the shown time is right

inline constexpr std::uint8_t kConsentRight =
    6;  // FirstStart: the consent text in force is meant to be (5: kConsentTake)

// Words at the start, dots and digits.
struct PinWords {
  const char* hint = nullptr;  // what is asked; stands beside what is told
  std::string_view told;       // empty: nothing
  Mood mood = Mood::Plain;     // of what is told
};
void pin_entry(StaffFrame& page, const char* title, const PinWords& words, Action done);

}  // namespace relievo::ui

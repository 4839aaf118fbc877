// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the pages with PINs share: StaffPage::Pin, FirstStart and Pins.
#pragma once

#include <string_view>

#include "ui/screens/parts/keyboard.h"
#include "ui/screens/service/staff_frame.h"

namespace relievo::ui {

// Words at the start, dots and digits.
struct PinWords {
  const char* hint = nullptr;  // what is asked; stands beside what is told
  std::string_view told;       // empty: nothing
  Mood mood = Mood::Plain;     // of what is told
};
void pin_entry(StaffFrame& page, std::string_view title, const PinWords& words, Action done);

}  // namespace relievo::ui

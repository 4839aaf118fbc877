// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the page of the touch screen's correction draws. Four crosses are touched, then one
// more with the new correction: only if that one is met is it kept. Plain data. Thread: main.
#pragma once

#include <array>
#include <cstdint>

#include "ui/device/touch_map.h"

namespace relievo::ui {

// Where the crosses stand, in shares of their room; the last is the one that tests.
inline constexpr std::array<TouchPoint, 5> kTouchCrosses{
    {{0.07F, 0.1F}, {0.93F, 0.1F}, {0.93F, 0.9F}, {0.07F, 0.9F}, {0.3F, 0.65F}}};
inline constexpr std::size_t kTouchFitted = 4;

enum class TouchStep : std::uint8_t { Rest, Cross, Test };
enum class TouchVerdict : std::uint8_t { None, Kept, Plain, NobodyTouched, Misfit, Missed, NotSaved };

struct TouchView {
  TouchStep step = TouchStep::Rest;
  TouchVerdict verdict = TouchVerdict::None;
  std::size_t cross = 0;   // which of kTouchCrosses is to be touched
  int seconds_left = 0;    // until everything is as it was
  bool corrected = false;  // a correction is in force
  bool measured = false;   // the figures below are of crosses that were touched just now
  double turned_deg = 0, off = 0;
  bool mirrored = false;
};

}  // namespace relievo::ui

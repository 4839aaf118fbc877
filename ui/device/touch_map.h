// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TouchMap: where on the picture a finger is, from where the panel says it is: an affine map, for panels that
// are mounted turned, mirrored, or a little off. fit_touch_map() finds it by least squares from crosses that
// were touched. Units: shares of the screen's width and height, so that it holds for every resolution.
// Angles: degrees, clockwise as seen. Thread: any. Errors of fit_touch_map(): InvalidInput (fewer than three
// crosses, touches on one line, a touch far off, a scale no panel has); parse: InvalidInput.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "hal/base/result.h"

namespace relievo::ui {

struct TouchPoint {
  float x = 0, y = 0;
};
struct TouchedCross {
  TouchPoint touched, cross;
};

struct TouchMap {
  // x' = m[0] x + m[1] y + m[2],  y' = m[3] x + m[4] y + m[5]
  std::array<double, 6> m{1, 0, 0, 0, 1, 0};
  TouchPoint operator()(TouchPoint at) const;
  bool is_plain() const { return *this == TouchMap{}; }
  bool operator==(const TouchMap&) const = default;
};

// What a person reads of one; `off` is the root mean square of what is left at the crosses, in shares of the
// screen.
struct TouchFit {
  TouchMap map;
  double off = 0;
  double turned_deg = 0;  // of the panel against the picture, -180 to 180
  bool mirrored = false;
};
inline constexpr double kMostTouchOff = 0.02;  // a fingertip's unsteadiness, twice

Result<TouchFit> fit_touch_map(std::span<const TouchedCross> crosses);
std::string text_of(const TouchMap& map);
Result<TouchMap> parse_touch_map(std::string_view text);

// What the page of the touch screen's correction draws. Four crosses are touched, then one
// more with the new correction: only if that one is met is it kept. Plain data. Thread: main.

// Where the crosses stand, in shares of their room; the last is the one that tests.
inline constexpr std::array<TouchPoint, 5> kTouchCrosses{
    {{0.07F, 0.1F}, {0.93F, 0.1F}, {0.93F, 0.9F}, {0.07F, 0.9F}, {0.3F, 0.65F}}};
inline constexpr std::size_t kTouchFitted = 4;

enum class TouchStep : std::uint8_t { Rest, Cross, Test };
enum class TouchVerdict : std::uint8_t { None, Kept, Plain, NobodyTouched, Misfit, Missed, NotSaved };

struct TouchView {
  TouchStep step = TouchStep::Rest;
  TouchVerdict verdict = TouchVerdict::None;
  std::size_t cross = 0;             // which of kTouchCrosses is to be touched
  int seconds_left = 0;              // until everything is as it was
  bool corrected = false;            // a correction is in force
  std::optional<TouchFit> fit = {};  // of crosses that were touched just now
};

}  // namespace relievo::ui

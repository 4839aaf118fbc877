// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Plot: a series of values as bars or as a line, with an axis of round numbers and the limit across it. Who
// listens is told the highest, the newest and the limit. It runs from left to right in every language, as
// tables of measurements do. Thread: main. Errors: none.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string_view>

#include "ui/draw/theme.h"

namespace relievo::ui {

enum class PlotLook : std::uint8_t { Bars, Line };

struct Plot {
  std::string_view id, title;
  std::string_view figure;  // beside the title: a sum, a median, what it is now
  Colour figure_ink{};      // not seen: as figures are
  const char* figure_sign = nullptr;
  std::span<const float> values;            // NaN: not known
  std::span<const std::string_view> names;  // where each value belongs on the axis: a day, a time
  PlotLook look = PlotLook::Bars;
  const char* unit = "";
  float limit = std::numeric_limits<float>::quiet_NaN();  // NaN: there is none
  std::array<std::string_view, 3>
      under{};  // at the axis' start, middle and end; empty: those of the values there
};

// From a round number to a round number, by a step of 1, 2 or 5 times a power of ten.
struct PlotScale {
  double from = 0, step = 1;
  int steps = 1;
  double to() const { return from + step * steps; }
  double share(double value) const { return (value - from) / (to() - from); }
  int decimals() const;  // that its numbers need
};
// Holds 0 and all that is known; of nothing: 0 to 1.
PlotScale plot_scale(std::span<const float> values, float limit);

}  // namespace relievo::ui

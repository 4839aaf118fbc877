// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Relative luminance and contrast as WCAG 2.2 define them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "ui/draw/draw_list.h"

namespace relievo::ui {

inline double luminance(Colour colour) {
  const auto linear = [](std::uint8_t v) {
    const double s = v / 255.0;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(colour.r) + 0.7152 * linear(colour.g) + 0.0722 * linear(colour.b);
}

inline double contrast(Colour text, Colour ground) {
  const double a = luminance(text), b = luminance(ground);
  return (std::max(a, b) + 0.05) / (std::min(a, b) + 0.05);
}

}  // namespace relievo::ui

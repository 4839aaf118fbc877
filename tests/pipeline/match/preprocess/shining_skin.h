// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// BumpScene painted as skin on which a lamp shines: each view sees the lamp's image at another place, as oily
// skin shows it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "tests/support/bump_scene.h"

namespace relievo::test {

// A lamp that skin mirrors: where its image stands in this view, its radius (one standard deviation), how
// bright (1: full light), and by which share of it one pixel mirrors more than its neighbour, as pores do.
struct Lamp {
  double x_px = 0, y_px = 0, radius_px = 1, light = 0, pores = 0;
};

// The view as skin of one reddish colour, lit well, lips about (x, y) redder still, and the lamp's white
// light upon it all; sRGB as a camera gives it.
struct Lips {
  double x_px = 0, y_px = 0, half_width_px = 0, half_height_px = 0;
};
inline void paint_skin(pipeline::RectifiedView& view, int width_px, const Lamp& lamp, const Lips& lips = {}) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  const auto encoded = [](double v) {
    return v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  };
  for (std::size_t k = 0; k < view.grey.size(); ++k) {
    const double dx = static_cast<double>(k % static_cast<std::size_t>(width_px)) - lamp.x_px;
    const double dy = static_cast<double>(k / static_cast<std::size_t>(width_px)) - lamp.y_px;
    const double skin = linear(std::clamp((100 + 0.5 * static_cast<double>(view.grey[k])) / 255, 0.0, 1.0));
    const double white = lamp.light * (1 + lamp.pores * (k * 31 / 7 % 2 == 0 ? 0.5 : -0.5)) *
                         std::exp(-0.5 * (dx * dx + dy * dy) / (lamp.radius_px * lamp.radius_px));
    double sum = 0;
    std::size_t channel = 3 * k;
    const bool lip = std::abs(dx + lamp.x_px - lips.x_px) < lips.half_width_px &&
                     std::abs(dy + lamp.y_px - lips.y_px) < lips.half_height_px;
    for (const auto& [skins, lipss] : {std::pair{1.4, 1.5}, {0.9, 0.75}, {0.7, 0.6}}) {
      const double value = 255 * std::clamp(encoded((lip ? lipss : skins) * skin + white), 0.0, 1.0);
      view.rgb[channel++] = static_cast<std::uint8_t>(std::lround(value));
      sum += value;
    }
    view.grey[k] = static_cast<float>(sum / 3);
  }
}

inline constexpr Lamp kLeftLamp{90, 80, 8, 0.2}, kRightLamp{84, 80, 8, 0.2};

inline const BumpScene kSkinScene{.width_px = 200, .height_px = 160, .bump_radius_px = 40, .right_gain = 0.7};

inline pipeline::RectifiedPair shining_skin(const BumpScene& scene, std::pmr::memory_resource* memory,
                                            double light) {
  pipeline::RectifiedPair pair = scene.render(memory);
  paint_skin(pair.left, pair.width_px, {kLeftLamp.x_px, kLeftLamp.y_px, kLeftLamp.radius_px, light});
  paint_skin(pair.right, pair.width_px, {kRightLamp.x_px, kRightLamp.y_px, kRightLamp.radius_px, light});
  return pair;
}

}  // namespace relievo::test

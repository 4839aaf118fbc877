// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/relief/relief_picture.h"

#include <algorithm>
#include <cmath>

namespace relievo::pipeline {

void draw_relief(const Relief& relief, double near_mm, double far_mm, std::uint8_t* grey) {
  const double scale = 215 / (1 / near_mm - 1 / far_mm);
  for (std::size_t i = 0; i < relief.depth_mm.size(); ++i) {
    const double z = static_cast<double>(relief.depth_mm[i]);
    grey[i] = z > 0 ? static_cast<std::uint8_t>(
                          std::lround(std::clamp(40 + scale * (1 / z - 1 / far_mm), 20.0, 255.0)))
                    : std::uint8_t{0};
  }
}

}  // namespace relievo::pipeline

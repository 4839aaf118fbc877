// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads a rectified photograph between its pixels (bilinear; clamped to the border).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

class PhotoSampler {
 public:
  PhotoSampler(const RectifiedView& view, int width_px, int height_px)
      : rgb_(view.rgb.data()), width_(width_px), last_x_(static_cast<float>(width_px - 1)),
        last_y_(static_cast<float>(height_px - 1)) {}

  void read(float x, float y, float (&rgb)[3]) const {
    x = std::clamp(x, 0.0F, last_x_);
    y = std::clamp(y, 0.0F, last_y_);
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    const float fx = x - static_cast<float>(column);
    const float fy = y - static_cast<float>(row);
    // On a whole row or column the second neighbour has no weight and may not exist.
    const std::size_t right = fx > 0 ? 3 : 0;
    const std::size_t below = fy > 0 ? 3 * static_cast<std::size_t>(width_) : 0;
    const std::uint8_t* p = rgb_ + 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                                        static_cast<std::size_t>(column));
    for (std::size_t i = 0; i < 3; ++i) {
      const float upper = static_cast<float>(p[i]) + fx * static_cast<float>(p[right + i] - p[i]);
      if (below == 0) {
        rgb[i] = upper;
        continue;
      }
      const std::uint8_t* q = p + below;
      const float lower = static_cast<float>(q[i]) + fx * static_cast<float>(q[right + i] - q[i]);
      rgb[i] = upper + fy * (lower - upper);
    }
  }

 private:
  const std::uint8_t* rgb_;
  int width_;
  float last_x_, last_y_;
};

inline std::uint8_t to_byte(float value) {
  return static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.0F, 255.0F));
}

}  // namespace relievo::pipeline

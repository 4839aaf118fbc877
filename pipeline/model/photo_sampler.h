// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads a rectified photograph between its pixels, clamped to its border.
// PhotoSampler: bilinear, anywhere. PhotoRow: one row after the other, by the cubic of Catmull and Rom
// (1974), which keeps a photograph's sharpness; it filters down the columns once a row.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

class PhotoSampler {
 public:
  PhotoSampler(std::span<const std::uint8_t> rgb, int width_px, int height_px)
      : rgb_(rgb.data()), width_(width_px), last_x_(float(width_px - 1)), last_y_(float(height_px - 1)) {}

  void read(float x, float y, float (&rgb)[3]) const {
    x = std::clamp(x, 0.0F, last_x_);
    y = std::clamp(y, 0.0F, last_y_);
    const int column = int(x);
    const int row = int(y);
    const float fx = x - float(column);
    const float fy = y - float(row);
    // On a whole row or column the second neighbour has no weight and may not exist.
    const std::size_t right = fx > 0 ? 3 : 0;
    const std::size_t below = fy > 0 ? 3 * std::size_t(width_) : 0;
    const std::uint8_t* p = rgb_ + 3 * (std::size_t(row) * std::size_t(width_) + std::size_t(column));
    const std::uint8_t* q = p + below;
    for (std::size_t i = 0; i < 3; ++i) {
      const float upper = float(p[i]) + fx * float(p[right + i] - p[i]);
      const float lower = float(q[i]) + fx * float(q[right + i] - q[i]);
      rgb[i] = upper + fy * (lower - upper);
    }
  }

 private:
  const std::uint8_t* rgb_;
  int width_;
  float last_x_, last_y_;
};

// Weights of the pixels -1, 0, 1, 2 around a place `f` beyond pixel 0.
inline void cubic_weights(float f, float (&w)[4]) {
  w[0] = 0.5F * f * (-1 + f * (2 - f));
  w[1] = 0.5F * (2 + f * f * (-5 + 3 * f));
  w[2] = 0.5F * f * (1 + f * (4 - 3 * f));
  w[3] = 0.5F * f * f * (f - 1);
}

class PhotoRow {
 public:
  // `buffer`: 3 floats a pixel of the picture's width. Columns outside `from` .. `to` are never read.
  PhotoRow(const RectifiedView& view, int width_px, int height_px, int from, int to, std::span<float> buffer)
      : rgb_(view.rgb.data()),
        width_(width_px),
        height_(height_px),
        from_(std::clamp(from, 0, width_px - 1)),
        to_(std::clamp(to, 0, width_px - 1)),
        buffer_(buffer) {}

  void move_to(float y) {
    y = std::clamp(y, 0.0F, float(height_ - 1));
    const int row = int(y);
    float w[4];
    cubic_weights(y - float(row), w);
    const std::uint8_t* rows[4];
    for (int i = 0; i < 4; ++i)
      rows[i] = rgb_ + 3 * std::size_t(std::clamp(row - 1 + i, 0, height_ - 1)) * std::size_t(width_);
    const std::size_t end = 3 * (std::size_t(to_) + 1);
    for (std::size_t k = 3 * std::size_t(from_); k < end; ++k)
      buffer_[k] = w[0] * float(rows[0][k]) + w[1] * float(rows[1][k]) + w[2] * float(rows[2][k]) +
                   w[3] * float(rows[3][k]);
  }

  void read(float x, float (&rgb)[3]) const {
    x = std::clamp(x, float(from_), float(to_));
    const int column = int(x);
    float w[4];
    cubic_weights(x - float(column), w);
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (int i = 0; i < 4; ++i) {
      const float* p = &buffer_[3 * std::size_t(std::clamp(column - 1 + i, from_, to_))];
      for (std::size_t c = 0; c < 3; ++c) rgb[c] += w[i] * p[c];
    }
  }

 private:
  const std::uint8_t* rgb_;
  int width_, height_, from_, to_;
  std::span<float> buffer_;
};

inline std::uint8_t to_byte(float value) { return std::uint8_t(std::clamp(value + 0.5F, 0.0F, 255.0F)); }

}  // namespace relievo::pipeline

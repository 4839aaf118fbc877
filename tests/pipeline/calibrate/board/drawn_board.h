// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A chessboard drawn through a homography, with area sampling, blur by the sampling, noise, and a
// slope of light: corners are known exactly.
#pragma once

#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

#include "hal/base/image_view.h"
#include "pipeline/calibrate/board/board_finder.h"

namespace relievo::tests {

struct DrawnBoard {
  int width_px = 640;
  int height_px = 480;
  double step_px = 42;                   // of a square, in the middle
  double origin[2] = {110, 105};         // of the first inner corner
  double lean[2] = {0.12, -0.05};        // shear
  double perspective[2] = {3e-4, 2e-4};  // per pixel of the board
  double noise = 2;                      // standard deviation, grey levels
  double dark = 40, bright = 200;
  double light_slope = 0;  // share of light lost from left to right
  pipeline::BoardPattern pattern{9, 6, 20};

  pipeline::Vec2d at(double column, double row) const {
    const double u = column * step_px;
    const double v = row * step_px;
    const double w = 1 + perspective[0] * u + perspective[1] * v;
    return {origin[0] + (u + lean[0] * v) / w, origin[1] + (v + lean[1] * u) / w};
  }
  // Board coordinates of a pixel, by solving the two linear equations of the map above.
  pipeline::Vec2d board_of(double x, double y) const {
    const double p = x - origin[0];
    const double q = y - origin[1];
    const double a = 1 - p * perspective[0];
    const double b = lean[0] - p * perspective[1];
    const double c = lean[1] - q * perspective[0];
    const double d = 1 - q * perspective[1];
    const double determinant = a * d - b * c;
    return {(p * d - q * b) / determinant / step_px, (q * a - p * c) / determinant / step_px};
  }
  double shade(double x, double y) const {
    const pipeline::Vec2d b = board_of(x, y);
    const bool inside = b.x > -1 && b.y > -1 && b.x < pattern.columns && b.y < pattern.rows;
    const int square = static_cast<int>(b.x + 100) + static_cast<int>(b.y + 100);
    return (!inside || square % 2 == 0 ? bright : dark) * (1 - light_slope * x / width_px);
  }
  std::vector<std::byte> draw(unsigned seed = 1) const {
    constexpr int kSub = 8;
    std::mt19937 random(seed);
    std::normal_distribution<double> noise_of(0, std::max(noise, 1e-9));
    std::vector<std::byte> grey;
    for (int y = 0; y < height_px; ++y)
      for (int x = 0; x < width_px; ++x) {
        double sum = 0;
        // A pixel collects the light of one and a half pixels: a little blur, as from a lens.
        for (int s = 0; s < kSub * kSub; ++s)
          sum += shade(x + 1.5 * ((s % kSub + 0.5) / kSub - 0.5), y + 1.5 * ((s / kSub + 0.5) / kSub - 0.5));
        grey.push_back(
            static_cast<std::byte>(std::clamp(sum / (kSub * kSub) + noise_of(random) + 0.5, 0.0, 255.0)));
      }
    return grey;
  }
  ImageView view(const std::vector<std::byte>& grey) const {
    return {grey.data(), width_px, height_px, width_px, PixelFormat::Grey8};
  }
};

}  // namespace relievo::tests

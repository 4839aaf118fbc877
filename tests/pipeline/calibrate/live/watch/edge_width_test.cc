// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/watch/board_tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace relievo::tests {
namespace {

const pipeline::BoardPattern kEdgeBoard{6, 4, 20};
constexpr int kEdgeViewWidth = 400;
constexpr int kEdgeViewHeight = 300;
constexpr double kStep = 48;

// A chessboard through two Gaussian blurs, one across the upright edges and one across the level ones.
struct BlurredBoard {
  double across_px = 1;
  double down_px = 1;
  double noise = 0;
  double turn_rad = 0;

  pipeline::Vec2d corner(int column, int row) const {
    const double u = kStep * column;
    const double v = kStep * row;
    return {80 + std::cos(turn_rad) * u - std::sin(turn_rad) * v,
            70 + std::sin(turn_rad) * u + std::cos(turn_rad) * v};
  }
  pipeline::BoardCorners corners() const {
    pipeline::BoardCorners all;
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 6; ++column) all.push_back(corner(column, row));
    return all;
  }
  double level(int x, int y) const {
    const double p = x - 80;
    const double q = y - 70;
    const double u = std::cos(turn_rad) * p + std::sin(turn_rad) * q;
    const double v = -std::sin(turn_rad) * p + std::cos(turn_rad) * q;
    return wave(u, across_px) * wave(v, down_px);
  }
  std::vector<std::byte> draw(PixelFormat format) const {
    std::mt19937 random(3);
    std::normal_distribution<double> noise_of(0, std::max(noise, 1e-9));
    std::vector<std::byte> bytes;
    for (int y = 0; y < kEdgeViewHeight; ++y)
      for (int x = 0; x < kEdgeViewWidth; ++x) {
        const double grey = 120 + 70 * level(x, y) + noise_of(random);
        const auto byte = [](double value) {
          return static_cast<std::byte>(static_cast<int>(value + 0.5) & 255);
        };
        if (format == PixelFormat::Grey16) {
          const int deep = static_cast<int>(grey * 256);
          bytes.push_back(static_cast<std::byte>(deep & 255));
          bytes.push_back(static_cast<std::byte>(deep >> 8));
        } else {
          for (int i = 0; i < bytes_per_pixel(format); ++i) bytes.push_back(byte(grey));
        }
      }
    return bytes;
  }
  double width(PixelFormat format = PixelFormat::Grey8) const {
    const auto bytes = draw(format);
    return pipeline::edge_width_px(
        {bytes.data(), kEdgeViewWidth, kEdgeViewHeight, kEdgeViewWidth * bytes_per_pixel(format), format},
        corners(), kEdgeBoard);
  }

 private:
  static double wave(double at, double sigma) {
    const double nearest = std::round(at / kStep);
    const double sign = static_cast<int>(nearest + 100) % 2 == 0 ? 1 : -1;
    return sign * std::erf((at - kStep * nearest) / (sigma * std::sqrt(2.0)));
  }
};

constexpr double kRise = 2.5631;  // of a Gaussian edge from 10 to 90 %, in its deviations

TEST(EdgeWidth, IsThatOfTheBlur) {
  for (const double sigma : {1.0, 1.5, 2.0, 3.0}) {
    EXPECT_NEAR((BlurredBoard{sigma, sigma}.width()), kRise * sigma, 0.12 * kRise * sigma) << sigma;
    EXPECT_NEAR((BlurredBoard{sigma, sigma, 0, 0.3}.width()), kRise * sigma, 0.12 * kRise * sigma) << sigma;
  }
}

TEST(EdgeWidth, MotionInOneDirectionCounts) {
  EXPECT_NEAR((BlurredBoard{3, 0.8}.width()), kRise * 3, 0.5);
  EXPECT_NEAR((BlurredBoard{0.8, 3}.width()), kRise * 3, 0.5);
}

TEST(EdgeWidth, NoiseAndFormatHardlyMatter) {
  const double clean = BlurredBoard{1.2, 1.2}.width();
  EXPECT_NEAR((BlurredBoard{1.2, 1.2, 4}.width()), clean, 0.25);
  EXPECT_NEAR((BlurredBoard{1.2, 1.2}.width(PixelFormat::Rgb8)), clean, 0.02);
  EXPECT_NEAR((BlurredBoard{1.2, 1.2}.width(PixelFormat::Grey16)), clean, 0.05);
}

TEST(EdgeWidth, IsNothingWhereThereIsNothing) {
  const std::vector<std::byte> flat(static_cast<std::size_t>(kEdgeViewWidth * kEdgeViewHeight),
                                    std::byte{90});
  const ImageView view{flat.data(), kEdgeViewWidth, kEdgeViewHeight, kEdgeViewWidth, PixelFormat::Grey8};
  EXPECT_EQ(pipeline::edge_width_px(view, BlurredBoard{}.corners(), kEdgeBoard), 0);
  const pipeline::BoardCorners unseen(24, {std::nan(""), std::nan("")});
  EXPECT_EQ(pipeline::edge_width_px(view, unseen, kEdgeBoard), 0);
}

}  // namespace
}  // namespace relievo::tests

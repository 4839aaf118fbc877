// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A board and a simulated face, blurred by known amounts: the share that is peaked falls with every step of
// blur; where there is only noise nothing is.
#include "firmware/capture/face_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "tests/support/head_album.h"

namespace relievo::firmware {
namespace {

constexpr int kWidth = 640, kHeight = 480, kSquare = 40;
using Levels = std::vector<double>;

Levels picture(const std::function<double(int, int)>& level) {
  Levels all;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) all.push_back(level(x, y));
  return all;
}

// Squares between plain areas, so that there is something without an edge.
double board(int x, int y) {
  if (x < 120 || x >= 520 || y < 120 || y >= 360) return 170;
  return ((x - 120) / kSquare + (y - 120) / kSquare) % 2 == 0 ? 40 : 220;
}

Levels blurred(const Levels& from, double sigma) {
  const int reach = static_cast<int>(std::ceil(4 * sigma));
  std::vector<double> weights;
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) weights.push_back(std::exp(-i * i / (2 * sigma * sigma)));
  for (const double w : weights) sum += w;
  const auto along = [&](const Levels& in, int dx, int dy) {
    return picture([&](int x, int y) {
      double all = 0;
      for (int i = -reach; i <= reach; ++i)
        all += weights[static_cast<std::size_t>(i + reach)] *
               in[static_cast<std::size_t>(std::clamp(y + i * dy, 0, kHeight - 1) * kWidth +
                                           std::clamp(x + i * dx, 0, kWidth - 1))];
      return all / sum;
    });
  };
  return along(along(from, 1, 0), 0, 1);
}

// With the noise of a camera: its deviation grows with the root of the light.
std::vector<std::byte> taken(const Levels& levels, double noise) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<std::byte> bytes;
  for (const double v : levels)
    bytes.push_back(std::byte(static_cast<unsigned char>(
        std::lround(std::clamp(v + noise * std::sqrt(0.1 + v / 128) * normal(random), 0.0, 255.0)))));
  return bytes;
}

struct Peaked {
  double share = 0;
  std::vector<std::uint8_t> rgb;
  bool at(int x, int y) const {
    return std::equal(FocusPeaking::kColour.begin(), FocusPeaking::kColour.end(),
                      rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * kWidth + x));
  }
};
Peaked peaked(const std::vector<std::byte>& grey) {
  Peaked result;
  result.rgb.assign(std::size_t{3} * kWidth * kHeight, 0);
  FocusPeaking peaking;
  result.share = peaking.mark({grey.data(), kWidth, kHeight, kWidth, PixelFormat::Grey8}, result.rgb.data(),
                              kWidth, kHeight);
  return result;
}

TEST(FocusPeaking, OfABoardFallsWithEveryStepOfBlurToNothing) {
  const Levels sharp = picture(board);
  for (const double noise : {0.0, 1.0, 3.0}) {
    double last = peaked(taken(blurred(sharp, 0.4), noise)).share;
    EXPECT_GT(last, 0.02) << "most edges, of a pixel or two";
    for (const double sigma : {0.7, 1.0, 1.3, 1.6, 2.0, 2.5, 3.5, 5.0}) {
      const double share = peaked(taken(blurred(sharp, sigma), noise)).share;
      EXPECT_LE(share, last) << sigma << " px, noise " << noise;
      last = share;
    }
    EXPECT_EQ(last, 0);
  }
}

TEST(FocusPeaking, MarksTheEdgesAndNothingBesideThem) {
  const Peaked sharp = peaked(taken(blurred(picture(board), 0.6), 2));
  int edges = 0, marked = 0;
  for (int y = 140; y < 340; y += 1)
    for (int x = 160; x < 480; x += kSquare) {
      if ((y - 120) % kSquare < 6 || (y - 120) % kSquare > kSquare - 6) continue;
      ++edges;
      marked += sharp.at(x - 1, y) || sharp.at(x, y) ? 1 : 0;
    }
  EXPECT_GT(marked, 0.98 * edges);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const bool outside = x < 112 || x >= 528 || y < 112 || y >= 368;
      const int u = (x - 120 + kSquare) % kSquare, v = (y - 120 + kSquare) % kSquare;
      const bool plain = outside || (u > 8 && u < kSquare - 8 && v > 8 && v < kSquare - 8);
      ASSERT_FALSE(plain && sharp.at(x, y)) << x << ' ' << y;
    }
}

TEST(FocusPeaking, NoiseIsNoEdge) {
  for (const double noise : {0.5, 1.0, 2.0, 4.0, 8.0}) {
    EXPECT_EQ(peaked(taken(picture([](int, int) { return 90.0; }), noise)).share, 0) << noise;
    EXPECT_EQ(peaked(taken(picture([](int x, int) { return 20 + 0.33 * x; }), noise)).share, 0)
        << "from dark to bright, " << noise;
  }
}

// The figure beside it, too: FocusHelp's sharpness.
TEST(FocusPeaking, OfASimulatedFaceFallsAsItsFocusFigureDoes) {
  test::Album& album = test::shared_album();
  const test::Shot& shot = album.shoot(1, test::standing(560));
  const hal::sim::PicturePair pair = album.develop(shot, {});
  const ImageView left = pair.left.view();
  const Levels face = picture([&](int x, int y) {
    return level_of(left.row(std::min(y, left.height_px - 1)), std::min(x, left.width_px - 1), left.format);
  });
  double last = 1, sharpness = 1e9, first = 0;
  for (const double sigma : {0.3, 0.6, 0.9, 1.2, 1.6, 2.4}) {
    const std::vector<std::byte> grey = taken(blurred(face, sigma), 0);
    const double share = peaked(grey).share;
    EXPECT_LT(share, last) << sigma;
    const ImageView shown{grey.data(), kWidth, kHeight, kWidth, PixelFormat::Grey8};
    const double now = face_light(shown, middle_box(shown))->sharpness;
    EXPECT_LT(now, sharpness) << sigma;
    if (first == 0) first = share;
    last = share, sharpness = now;
  }
  EXPECT_GT(first, 0.005) << "the face is a third of the picture";
  EXPECT_LT(last, first / 20);
}

}  // namespace
}  // namespace relievo::firmware

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/light/face_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hal/sim/base/noise.h"
#include "tests/pipeline/gate/seen_relief.h"

namespace relievo::pipeline {
namespace {

constexpr int kBlurWidth = 480, kBlurHeight = 200;
constexpr double kStripePx = 24;

// Upright stripes above, level ones below, whose edges a bell of these deviations has blurred.
struct Look {
  double across_px = 0.6, down_px = 0.6, contrast = 90, noise = 0;
};

double wave(double at, double deviation_px) {
  double sum = 0;
  for (int k = -2; k <= 2; ++k) {
    const double edge = (std::floor(at / kStripePx) + k) * kStripePx;
    sum += (std::lround(edge / kStripePx) % 2 == 0 ? 1 : -1) *
           std::erf((at - edge) / (deviation_px * std::sqrt(2)));
  }
  return sum;  // -1 .. 1
}

std::vector<std::uint8_t> picture(const Look& look, std::uint64_t seed) {
  hal::sim::Random random(seed);
  std::vector<std::uint8_t> pixels(std::size_t{kBlurWidth} * kBlurHeight);
  for (int y = 0; y < kBlurHeight; ++y)
    for (int x = 0; x < kBlurWidth; ++x)
      pixels[static_cast<std::size_t>(y * kBlurWidth + x)] = static_cast<std::uint8_t>(std::lround(
          120 +
          0.5 * look.contrast *
              (y < kBlurHeight / 2 ? wave(x + 0.5, look.across_px) : wave(y + 0.5, look.down_px)) +
          look.noise * random.normal()));
  return pixels;
}

double blur_mm(const Look& left, const Look& right) {
  const CameraIntrinsics camera{
      {kFocalPx, kFocalPx}, {kBlurWidth / 2.0, kBlurHeight / 2.0}, {}, kBlurWidth, kBlurHeight};
  StereoCalibration calibration;
  calibration.left = calibration.right = camera;
  calibration.right_from_left.translation_mm = {-60, 0, 0};
  const std::vector<std::uint8_t> a = picture(left, 1), b = picture(right, 2);
  const auto view = [](const std::vector<std::uint8_t>& p) {
    return ImageView{reinterpret_cast<const std::byte*>(p.data()), kBlurWidth, kBlurHeight, kBlurWidth,
                     PixelFormat::Grey8};
  };
  Workspace work(1, std::size_t{1} << 20, std::size_t{16} << 20);
  Relief relief(&work.output);
  HeadMeasurement head;
  head.known = true;
  head.tip_mm = {0, 18, kFaceDistanceMm};
  head.right = {1, 0, 0}, head.down = {0, 1, 0}, head.away = {0, 0, 1};
  return measure_blur_mm({view(a), view(b)}, calibration, relief, head, work.context);
}
double blur_mm(const Look& look) { return blur_mm(look, look); }

TEST(EdgeBlur, MeasuresTheBlurInMillimetres) {
  for (const double px : {1.0, 1.5, 2.0, 3.0})
    EXPECT_NEAR(blur_mm({px, px}), px * kPixelMm, 0.15 * px * kPixelMm + 0.05) << px;
  EXPECT_LT(blur_mm({0.5, 0.5}), 0.6);
}

TEST(EdgeBlur, AsksNeitherContrastNorNoise) {
  for (const double px : {1.0, 2.5}) {
    const double clean = blur_mm({px, px, 120});
    EXPECT_NEAR(blur_mm({px, px, 40}), clean, 0.12 * clean) << px;
    EXPECT_NEAR(blur_mm({px, px, 120, 4}), clean, 0.15 * clean) << px;
  }
}

TEST(EdgeBlur, TheWorseDirectionOfTheWorseCameraCounts) {
  const double smeared = blur_mm({3, 0.6});
  EXPECT_NEAR(smeared, 3 * kPixelMm, 0.2 * 3 * kPixelMm);
  EXPECT_NEAR(blur_mm({0.6, 3}), smeared, 0.2 * smeared);
  EXPECT_NEAR(blur_mm({0.6, 0.6}, {3, 3}), 3 * kPixelMm, 0.2 * 3 * kPixelMm);
}

TEST(EdgeBlur, WhereNoEdgeIsLeftItIsAllBlur) { EXPECT_EQ(blur_mm({1, 1, 0, 2}), kMostBlurMm); }

}  // namespace
}  // namespace relievo::pipeline

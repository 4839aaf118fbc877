// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/capture/face_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace relievo::firmware {
namespace {

constexpr int kPictureSide = 80;

// Bars whose edges are smeared over about `blur_px`, between two levels of 0 to 255.
std::vector<double> bars(double blur_px, double low, double high) {
  std::vector<double> picture;
  for (int y = 0; y < kPictureSide; ++y)
    for (int x = 0; x < kPictureSide; ++x) {
      const double wave = std::sin(2 * M_PI * x / 16.0) * 16 / (2 * M_PI);  // pixels from the nearest edge
      picture.push_back(low + (high - low) * 0.5 * (1 + std::tanh(wave / blur_px)));
    }
  return picture;
}

struct Shown {
  std::vector<std::byte> bytes;
  ImageView view;
  Shown(const std::vector<double>& levels, PixelFormat format) {
    for (const double v : levels) {
      const auto b = std::byte(static_cast<unsigned char>(std::lround(v)));
      if (format == PixelFormat::Grey16) bytes.push_back(std::byte{0});
      if (format == PixelFormat::Rgb8) bytes.push_back(std::byte{7});
      bytes.push_back(b);
      if (format == PixelFormat::Rgb8) bytes.push_back(std::byte{200});
    }
    view = {bytes.data(), kPictureSide, kPictureSide, kPictureSide * bytes_per_pixel(format), format};
  }
  FaceLight light(const FaceBox& box = {0, 0, kPictureSide, kPictureSide}) const {
    return *face_light(view, box);
  }
};

TEST(FaceLight, MeasuresBrightnessInEveryFormat) {
  std::vector<double> levels(kPictureSide * kPictureSide);
  for (std::size_t i = 0; i < levels.size(); ++i) levels[i] = i % 100 < 90 ? 51 : i % 100 < 98 ? 153 : 255;
  for (const PixelFormat format : {PixelFormat::Grey8, PixelFormat::Grey16, PixelFormat::Rgb8}) {
    const FaceLight light = Shown(levels, format).light();
    EXPECT_NEAR(light.mean, (0.9 * 51 + 0.08 * 153 + 0.02 * 255) / 255, 1e-6);
    EXPECT_NEAR(light.bright, 0.6, 1e-6);
    EXPECT_NEAR(light.highlight, 1, 1e-6);
    EXPECT_NEAR(light.clipped, 0.02, 1e-6);
  }
}

TEST(FaceLight, LooksAtTheFaceOnly) {
  std::vector<double> levels(kPictureSide * kPictureSide, 250);
  for (int y = 20; y < 60; ++y) std::fill_n(levels.begin() + y * kPictureSide + 20, 40, 100.0);
  const Shown shown(levels, PixelFormat::Grey8);
  EXPECT_NEAR(shown.light(middle_box(shown.view)).mean, 100.0 / 255, 1e-6);
  EXPECT_NEAR(shown.light({20, 20, 40, 40}).bright, 100.0 / 255, 1e-6);
}

TEST(FaceLight, ABoxOutsideThePictureIsRefused) {
  const Shown shown(bars(1, 50, 200), PixelFormat::Grey8);
  for (const FaceBox box :
       {FaceBox{70, 0, 40, 40}, FaceBox{-100, 0, 110, 40}, FaceBox{0, 0, 15, 40}, FaceBox{0, 0, 0, 0}})
    EXPECT_EQ(face_light(shown.view, box).error().code, Errc::InvalidInput);
  EXPECT_TRUE(face_light(shown.view, {-20, -20, 60, 60}));
  EXPECT_FALSE(face_light({}, {0, 0, 40, 40}));
}

TEST(FaceLight, SharpnessFallsWithBlurAndNotWithLight) {
  double last = 1e9;
  for (const double blur : {0.3, 0.6, 1.0, 1.5, 2.0, 3.0, 5.0}) {
    const double sharp = Shown(bars(blur, 60, 200), PixelFormat::Grey8).light().sharpness;
    EXPECT_LT(sharp, 0.99 * last) << blur;
    EXPECT_NEAR(Shown(bars(blur, 30, 100), PixelFormat::Grey8).light().sharpness, sharp, 0.05 * sharp);
    last = sharp;
  }
}

TEST(FaceLight, AFlatPictureHasNoSharpness) {
  EXPECT_EQ(Shown(std::vector<double>(kPictureSide * kPictureSide, 90), PixelFormat::Grey8).light().sharpness,
            0);
}

TEST(FocusHelp, TellsTheShareOfTheBest) {
  FocusHelp help;
  EXPECT_EQ(help.share_of_best({}), 0);
  const auto seen = [&](double blur) {
    return help.share_of_best(Shown(bars(blur, 60, 200), PixelFormat::Grey8).light());
  };
  EXPECT_EQ(seen(3), 1);
  EXPECT_EQ(seen(1), 1) << "sharper than before";
  const double past = seen(2);
  EXPECT_LT(past, 0.95);
  EXPECT_GT(past, 0);
  help.reset();
  EXPECT_EQ(seen(2), 1);
}

}  // namespace
}  // namespace relievo::firmware

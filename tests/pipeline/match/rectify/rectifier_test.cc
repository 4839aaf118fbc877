// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/rectify/rectifier.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/lying_sensor.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

// A toed-in, slightly rolled and distorted rig.
StereoCalibration toed_in(int width, int height) {
  StereoCalibration c;
  c.left = {{900, 905}, {width / 2.0 + 3, height / 2.0 - 2}, {-0.11, 0.12, 2e-4, -1e-4, 0.01}, width, height};
  c.right = {{895, 899}, {width / 2.0 - 5, height / 2.0 + 4}, {-0.10, 0.09, -2e-4, 3e-4, 0.0}, width, height};
  const double a = 0.24;  // toe-in, right camera turned towards the left one
  const double r = 0.01;  // roll
  // right_from_left = Rz(r) * Ry(a); the right camera stands 120 mm to the right.
  const double ca = std::cos(a), sa = std::sin(a), cr = std::cos(r), sr = std::sin(r);
  c.right_from_left.rotation = {{cr * ca, -sr, cr * sa, sr * ca, cr, sr * sa, -sa, 0, ca}};
  const Vec3d centre{120, 1.5, 14};
  const Vec3d t = apply(c.right_from_left.rotation, centre);
  c.right_from_left.translation_mm = {-t.x, -t.y, -t.z};
  return c;
}

// The test's own projection, written from the camera model's definition.
Vec2d project(const CameraIntrinsics& camera, const Vec3d& p) {
  const double x = p.x / p.z;
  const double y = p.y / p.z;
  const double r2 = x * x + y * y;
  const double* k = camera.distortion;
  const double s = 1 + k[0] * r2 + k[1] * r2 * r2 + k[4] * r2 * r2 * r2;
  return {camera.focal_px.x * (x * s + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x)) + camera.centre_px.x,
          camera.focal_px.y * (y * s + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y) + camera.centre_px.y};
}

TEST(RectifiedGeometry, APointLiesOnTheSameRowInBothViewsAtTheStatedDepth) {
  const StereoCalibration c = toed_in(640, 480);
  test::StageFixture fixture(1 << 20, 1 << 20);
  RectifiedPair pair(&fixture.output);
  ASSERT_TRUE(lay_windows(c, {}, pair));
  for (double z = 420; z < 700; z += 40)
    for (double x = -60; x <= 100; x += 20)
      for (double y = -80; y <= 80; y += 20) {
        const Vec3d in_left{x, y, z};
        const Vec3d p = apply(pair.rectified_from_left, in_left);
        const double u = pair.focal_px * p.x / p.z + pair.left_centre_px.x;
        const double v = pair.focal_px * p.y / p.z + pair.left_centre_px.y;
        const double u_right = pair.focal_px * (p.x - pair.baseline_mm) / p.z + pair.right_centre_px.x;
        EXPECT_NEAR(pair.depth_mm(u - u_right), p.z, 1e-6);
        const Vec2d left =
            source_pixel(c.left, pair.rectified_from_left, pair.focal_px, pair.left_centre_px, {u, v});
        const Vec2d right = source_pixel(c.right, pair.rectified_from_right, pair.focal_px,
                                         pair.right_centre_px, {u_right, v});
        const Vec2d left_truth = project(c.left, in_left);
        const Vec2d right_truth = project(c.right, apply(c.right_from_left, in_left));
        EXPECT_NEAR(left.x, left_truth.x, 1e-6);
        EXPECT_NEAR(left.y, left_truth.y, 1e-6);
        EXPECT_NEAR(right.x, right_truth.x, 1e-6);
        EXPECT_NEAR(right.y, right_truth.y, 1e-6);
      }
}

TEST(RectifiedGeometry, TheWindowsHoldBothWholePictures) {
  const StereoCalibration c = toed_in(640, 480);
  test::StageFixture fixture(1 << 20, 1 << 20);
  RectifiedPair pair(&fixture.output);
  ASSERT_TRUE(lay_windows(c, {}, pair));
  // Neither zoomed (the scale is the cameras' own) nor cut: the centre of each picture is well inside.
  EXPECT_NEAR(pair.focal_px, 900, 10);
  EXPECT_LT(pair.width_px, 800);
  EXPECT_GT(pair.width_px, 600);
}

// Sensors that lie on their side see what upright ones see: the windows are the same.
TEST(RectifiedGeometry, LyingSensorsGiveUprightWindows) {
  const StereoCalibration c = toed_in(480, 640);
  test::StageFixture fixture(1 << 20, 1 << 20);
  RectifiedPair upright(&fixture.output), pair(&fixture.output);
  ASSERT_TRUE(lay_windows(c, {}, upright));
  for (const test::Side side : {test::Side::Clockwise, test::Side::Counterclockwise}) {
    const StereoCalibration lying = test::laid(c, side);
    ASSERT_TRUE(lay_windows(lying, {}, pair));
    EXPECT_EQ(pair.width_px, upright.width_px);
    EXPECT_EQ(pair.height_px, upright.height_px);
    for (const Vec2d at : {Vec2d{20, 30}, Vec2d{300, 500}, Vec2d{250, 90}}) {
      const Vec2d expected = test::laid(
          source_pixel(c.right, upright.rectified_from_right, upright.focal_px, upright.right_centre_px, at),
          480, 640, side);
      const Vec2d found =
          source_pixel(lying.right, pair.rectified_from_right, pair.focal_px, pair.right_centre_px, at);
      EXPECT_NEAR(found.x, expected.x, 1e-6);
      EXPECT_NEAR(found.y, expected.y, 1e-6);
    }
  }
}

TEST(RectifiedGeometry, CamerasBehindEachOtherAreRefused) {
  StereoCalibration c = toed_in(640, 480);
  c.right_from_left.translation_mm = {-20, 0, -100};
  c.right_from_left.rotation = {};
  test::StageFixture fixture(1 << 20, 1 << 20);
  RectifiedPair pair(&fixture.output);
  const auto laid = lay_windows(c, {}, pair);
  ASSERT_FALSE(laid);
  EXPECT_NE(laid.error().what.view().find("not behind"), std::string_view::npos);
}

TEST(RectifiedGeometry, SwappedCamerasAreNamed) {
  StereoCalibration c = toed_in(640, 480);
  c.right_from_left = inverse(c.right_from_left);
  test::StageFixture fixture(1 << 20, 1 << 20);
  RectifiedPair pair(&fixture.output);
  const auto laid = lay_windows(c, {}, pair);
  ASSERT_FALSE(laid);
  EXPECT_NE(laid.error().what.view().find("swapped"), std::string_view::npos);
}

TEST(RectifiedGeometry, WindowsLargerThanAllowedAreRefused) {
  StereoCalibration c = toed_in(480, 640);
  c.right_from_left = {{}, {-120, 0, 0}};  // side by side: the windows are as large as the pictures
  test::StageFixture fixture(1 << 20, 1 << 20);
  RectifiedPair pair(&fixture.output);
  ASSERT_TRUE(lay_windows(c, {.longest_side_px = 700}, pair));
  ASSERT_LT(pair.width_px, 560);
  for (const int longest : {560, 400}) {
    const auto laid = lay_windows(c, {.longest_side_px = longest}, pair);
    ASSERT_FALSE(laid) << longest;
    EXPECT_EQ(laid.error().code, Errc::InvalidInput);
  }
}

// No ray of it counts, and a box without rays has no size that an int could hold.
TEST(RectifiedGeometry, ACameraThatLooksBackIsRefused) {
  StereoCalibration c = toed_in(640, 480);
  for (const double a : {3.1, std::acos(-1.0)}) {
    c.right_from_left.rotation = {{std::cos(a), 0, std::sin(a), 0, 1, 0, -std::sin(a), 0, std::cos(a)}};
    const Vec3d t = apply(c.right_from_left.rotation, {120, 0, 0});
    c.right_from_left.translation_mm = {-t.x, -t.y, -t.z};
    test::StageFixture fixture(1 << 20, 1 << 20);
    RectifiedPair pair(&fixture.output);
    const auto laid = lay_windows(c, {}, pair);
    ASSERT_FALSE(laid) << a;
    EXPECT_EQ(laid.error().code, Errc::InvalidInput);
  }
}

TEST(Rectifier, ResamplesASmoothPictureToItsAnalyticValues) {
  const int w = 320;
  const int h = 240;
  StereoCalibration c = toed_in(w, h);
  c.left.focal_px = c.right.focal_px = {450, 450};
  const auto shade = [](double x, double y) { return 128 + 60 * std::sin(0.05 * x) * std::cos(0.04 * y); };
  std::vector<std::uint16_t> picture(static_cast<std::size_t>(w * h));
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      picture[static_cast<std::size_t>(y * w + x)] =
          static_cast<std::uint16_t>(std::lround(257 * shade(x, y)));
  const ImageView view{reinterpret_cast<const std::byte*>(picture.data()), w, h, 2 * w, PixelFormat::Grey16};
  test::StageFixture fixture;
  const auto pair = run_stage(fixture.context, [&](StageContext& ctx) {
    return RectifierOptions{}.rectify({view, view}, c, ctx);
  });
  ASSERT_TRUE(pair);
  std::size_t seen = 0;
  for (int y = 0; y < pair->height_px; ++y)
    for (int x = 0; x < pair->width_px; ++x) {
      const auto k = static_cast<std::size_t>(y) * static_cast<std::size_t>(pair->width_px) +
                     static_cast<std::size_t>(x);
      if (pair->left.valid[k] == 0) continue;
      ++seen;
      const Vec2d from = source_pixel(c.left, pair->rectified_from_left, pair->focal_px, pair->left_centre_px,
                                      {static_cast<double>(x), static_cast<double>(y)});
      ASSERT_NEAR(pair->left.grey[k], shade(from.x, from.y), 0.1) << x << "," << y;
    }
  EXPECT_GT(seen, static_cast<std::size_t>(w * h) * 9 / 10);
}

TEST(Rectifier, RefusesWhatIsNotThisCalibrations) {
  const StereoCalibration c = toed_in(160, 120);
  std::vector<std::byte> bytes(160 * 120 * 3);
  const ImageView right_size{bytes.data(), 160, 120, 480, PixelFormat::Rgb8};
  const ImageView wrong_size{bytes.data(), 152, 120, 456, PixelFormat::Rgb8};
  test::StageFixture fixture(1 << 22, 1 << 22);
  for (const auto& [left, right] : {std::pair{wrong_size, right_size}, std::pair{right_size, wrong_size},
                                    std::pair{ImageView{}, right_size}}) {
    const auto pair = run_stage(fixture.context, [&, l = left, r = right](StageContext& ctx) {
      return RectifierOptions{}.rectify({l, r}, c, ctx);
    });
    ASSERT_FALSE(pair);
    EXPECT_EQ(pair.error().code, Errc::InvalidInput);
    EXPECT_FALSE(pair.error().where().empty());
  }
}

TEST(Rectifier, TakesAPictureStoredFromBelowAndRefusesRowsThatOverlap) {
  const StereoCalibration c = toed_in(160, 120);
  std::vector<std::byte> bytes(160 * 120 * 3);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i / 480 + i % 7);
  std::vector<std::byte> from_below;
  for (std::size_t y = 120; y-- > 0;)
    from_below.insert(from_below.end(), bytes.begin() + std::ptrdiff_t(y * 480),
                      bytes.begin() + std::ptrdiff_t(y * 480 + 480));
  const ImageView view{bytes.data(), 160, 120, 480, PixelFormat::Rgb8};
  const ImageView upwards{from_below.data() + 119 * 480, 160, 120, -480, PixelFormat::Rgb8};
  test::StageFixture fixture(1 << 22, 1 << 22);
  const auto rectified = [&](const ImageView& left, const ImageView& right) {
    return run_stage(fixture.context, [&](StageContext& ctx) {
      return RectifierOptions{}.rectify({left, right}, c, ctx);
    });
  };
  const auto pair = rectified(view, upwards), same = rectified(view, view);
  ASSERT_TRUE(pair && same);
  EXPECT_EQ(pair->right.grey, same->right.grey);
  for (const int stride : {0, 479, -479, 160}) {
    ImageView wrong = view;
    wrong.stride_bytes = stride;
    for (const auto& refused : {rectified(wrong, view), rectified(view, wrong)}) {
      ASSERT_FALSE(refused) << stride;
      EXPECT_EQ(refused.error().code, Errc::InvalidInput);
    }
  }
}

TEST(Rectifier, EveryArenaTooSmallSaysSo) {
  const StereoCalibration c = toed_in(160, 120);
  std::vector<std::byte> bytes(160 * 120 * 3);
  const ImageView view{bytes.data(), 160, 120, 480, PixelFormat::Rgb8};
  bool succeeded = false;
  for (std::size_t size = 512; size < (1U << 24) && !succeeded; size += size / 3) {
    test::StageFixture fixture(size, size, 1);
    const auto pair = run_stage(fixture.context, [&](StageContext& ctx) {
      return RectifierOptions{}.rectify({view, view}, c, ctx);
    });
    succeeded = pair.has_value();
    if (!succeeded) {
      EXPECT_EQ(pair.error().code, Errc::OutOfMemory);
    }
  }
  EXPECT_TRUE(succeeded);
}

}  // namespace
}  // namespace relievo::pipeline

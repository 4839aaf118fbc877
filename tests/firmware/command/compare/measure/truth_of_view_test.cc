// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rig's truth brought into the rectified view of a toed-in rig with a bent lens: a tilted plane, whose
// every disparity is known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "firmware/measure/comparison.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "pipeline/match/rectify/rectifier.h"
#include "tests/support/stage_fixture.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware::compare {
namespace {

constexpr int kViewWidth = 240;
constexpr int kViewHeight = 180;
constexpr double kTilt = 0.3;  // the plane z = 500 + kTilt x

pipeline::StereoCalibration rig() {
  pipeline::StereoCalibration c;
  for (pipeline::CameraIntrinsics* camera : {&c.left, &c.right})
    *camera = {{500, 500},
               {0.5 * (kViewWidth - 1), 0.5 * (kViewHeight - 1)},
               {-0.1, 0, 0, 0, 0},
               kViewWidth,
               kViewHeight};
  const double a = 0.2;
  c.right_from_left.rotation = {{std::cos(a), 0, std::sin(a), 0, 1, 0, -std::sin(a), 0, std::cos(a)}};
  c.right_from_left.translation_mm = {-100, 0, 5};
  return c;
}

// Depth of the plane where the pixel looks.
double depth(const pipeline::CameraIntrinsics& c, double u, double v) {
  const double xd = (u - c.centre_px.x) / c.focal_px.x;
  const double yd = (v - c.centre_px.y) / c.focal_px.y;
  double x = xd;
  double y = yd;
  for (int i = 0; i < 40; ++i) {
    const double s = 1 + c.distortion[0] * (x * x + y * y);
    x = xd / s;
    y = yd / s;
  }
  return 500 / (1 - kTilt * x);
}

TEST(TruthOfView, DisparitiesOfATiltedPlaneAreThoseOfGeometry) {
  const test::TemporaryFolder here;
  const pipeline::StereoCalibration c = rig();
  ASSERT_TRUE(pipeline::write_calibration(here / "rig.yml", c));
  std::string text = std::to_string(kViewWidth) + " " + std::to_string(kViewHeight) + " z\n";
  for (int y = 0; y < kViewHeight; ++y)
    for (int x = 0; x < kViewWidth; ++x) {
      const auto z = static_cast<float>(depth(c.left, x, y));
      char bytes[4];
      std::memcpy(bytes, &z, 4);
      text.append(bytes, 4);
    }
  text.append(static_cast<std::size_t>(kViewWidth * kViewHeight), '\x07');
  test::write_text(here / "truth.bin", text);
  const auto view = measure::TruthView::read(here.path());
  ASSERT_TRUE(view) << view.error().where();

  test::StageFixture fixture(std::size_t{16} << 20, std::size_t{16} << 20, 1);
  const std::vector<std::byte> blank(static_cast<std::size_t>(kViewWidth * kViewHeight));
  const ImageView picture{blank.data(), kViewWidth, kViewHeight, kViewWidth, PixelFormat::Grey8};
  const auto pair = pipeline::RectifierOptions{}.rectify({picture, picture}, c, fixture.context);
  ASSERT_TRUE(pair) << pair.error().what.view();
  const DisparityTruth truth = truth_of_view(*view, *pair);
  int known = 0;
  for (int y = 0; y < pair->height_px; y += 5)
    for (int x = 0; x < pair->width_px; x += 5) {
      if (!truth.map.known(x, y)) continue;
      ++known;
      // Where the ray of this rectified pixel meets the plane n . p = 500, in the left camera's frame.
      const pipeline::Vec3d ray{(x - pair->left_centre_px.x) / pair->focal_px,
                                (y - pair->left_centre_px.y) / pair->focal_px, 1};
      const pipeline::Vec3d in_left = pipeline::apply(pipeline::transposed(pair->rectified_from_left), ray);
      const double z_rectified = 500 / (in_left.z - kTilt * in_left.x);
      ASSERT_NEAR(truth.map.at(x, y), pair->disparity_px(z_rectified), 0.01) << x << ", " << y;
    }
  EXPECT_GT(known, 200) << "what lies within 95 mm of the nearest point";
}

}  // namespace
}  // namespace relievo::firmware::compare

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The live page is a lamp: how much of its light, as it is drawn, arrives on a simulated face.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "firmware/capture/face_light.h"
#include "hal/picture_file.h"
#include "hal/sim/render.h"

namespace relievo::firmware {
namespace {

// Of a white page's. The oval is the mirror: a dark room in it sends nothing.
double light_around_mirror(const hal::Picture& page) {
  constexpr double kMiddleX = 640, kMiddleY = 400, kHalfWide = 214, kHalfHigh = 291;  // as drawn
  double sum = 0;
  for (int y = 0; y < page.height_px; ++y)
    for (int x = 0; x < page.width_px; ++x) {
      if (std::hypot((x - kMiddleX) / kHalfWide, (y - kMiddleY) / kHalfHigh) < 1) continue;
      for (int c = 0; c < 3; ++c) {
        const auto at = static_cast<std::size_t>(3 * (y * page.width_px + x) + c);
        const double v = std::to_integer<int>(page.bytes[at]) / 255.0;
        sum += v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
      }
    }
  return sum / static_cast<double>(page.bytes.size());
}

TEST(ScreenLight, TheLivePageLightsTheFace) {
  const auto page = hal::read_picture(std::filesystem::path(RELIEVO_SOURCE_DIR) /
                                      "tests/golden/pages/position_aside_1280x800_100_ar.png");
  ASSERT_TRUE(page.has_value());
  const double share = light_around_mirror(*page);
  EXPECT_GT(share, 0.6);
  ThreadPool pool(2);
  const hal::sim::SimulationOptions options;
  hal::sim::RigOptions small = options.rig;
  small.width_px = 480;
  small.height_px = 300;
  hal::sim::SensorOptions sensor = options.sensor;
  sensor.noise = 0;
  sensor.gamma = false;
  const auto head = hal::sim::make_head(hal::sim::traits_of(1), pool);
  const auto face = [&](double lamps, double screen) {
    const auto scene = hal::sim::make_head_scene(
        head, options.pose, pool, {.left = lamps, .right = lamps, .below = lamps, .screen = screen});
    const auto pair = hal::sim::render_pair(*scene, hal::sim::make_rig(small), sensor, 1, pool);
    const auto light = face_light(pair.left.view(), {200, 110, 80, 80});
    EXPECT_TRUE(light.has_value());
    return light ? light->mean : 0;
  };
  const double dark = face(0, 0), lit = face(0, share), lamps = face(1, 0), both = face(1, share);
  std::printf(
      "the page sends %.2f of a white page's light; the face: %.3f in the dim room, %.3f with the page, "
      "%.3f with the lamps, %.3f with both\n",
      share, dark, lit, lamps, both);
  EXPECT_GT(lit, 1.2 * dark) << "with the lamps off the screen alone brightens the face";
  EXPECT_GT(both, 1.03 * lamps);
}

}  // namespace
}  // namespace relievo::firmware

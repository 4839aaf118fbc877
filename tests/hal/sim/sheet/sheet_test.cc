// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sheet that is bent keeps its lengths, and a camera sees its picture where it must.
#include <gtest/gtest.h>

#include <cmath>

#include "hal/base/thread_pool.h"
#include "hal/sim/render.h"
#include "hal/sim/sheet/sheet_photo.h"

namespace relievo::hal::sim {
namespace {

const SheetBend kBends[] = {
    {}, {80, 0, 0, 0}, {-60, 35, 0, 0}, {120, 90, 300, 0}, {-90, 200, -400, 0}, {70, 20, 0, 130}};

// Left half red, right half green, a blue bottom.
Picture flag() {
  Picture p;
  p.width_px = 60, p.height_px = 80, p.format = PixelFormat::Rgb8;
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 60; ++x)
      for (const int v : {y < 60 && x < 30 ? 255 : 0, y < 60 && x >= 30 ? 255 : 0, y >= 60 ? 255 : 0})
        p.bytes.push_back(static_cast<std::byte>(v));
  return p;
}

// Paper is not stretched: neighbouring points stay as far apart along any direction, at any place.
TEST(SheetShape, BendingStretchesNothing) {
  constexpr double kStep = 0.01;
  for (const SheetBend& bend : kBends)
    for (double u = -100; u <= 100; u += 12.5)
      for (double v = -140; v <= 140; v += 17.5)
        for (const auto& [du, dv] :
             {std::pair{1.0, 0.0}, std::pair{0.0, 1.0}, std::pair{0.6, 0.8}, std::pair{-0.8, 0.6}}) {
          const Vec3 a = bent(bend, u - kStep * du, v - kStep * dv),
                     b = bent(bend, u + kStep * du, v + kStep * dv);
          EXPECT_NEAR(length(b - a) / (2 * kStep), 1, 1e-4)
              << bend.radius_mm << " " << bend.apex_mm << " " << bend.wave_mm << " at " << u << ", " << v;
        }
}

TEST(SheetShape, BulgesTowardsWhoLooksWhereTheRadiusIsPositive) {
  EXPECT_GT(bent({80, 0, 0, 0}, 50, 0).z, 10);  // its side goes back
  EXPECT_LT(bent({-80, 0, 0, 0}, 50, 0).z, -10);
  EXPECT_NEAR(bent({80, 0, 0, 0}, 0, 100).z, 0, 1e-12);  // along the lines that stay straight
  EXPECT_NEAR(bent({80, 90, 0, 0}, 100, 0).z, 0, 1e-12);
  EXPECT_GT(bent({80, 0, 300, 0}, 50, 0).z, 10);
}

TEST(SheetShape, TheMeshLeavesTheSurfaceByLessThanAHundredthOfAMillimetre) {
  for (const SheetBend& bend : kBends) {
    const SheetMesh sheet = make_sheet({200, 120}, bend);
    for (std::size_t k = 0; k < sheet.mesh.triangles.size(); k += 37) {
      const auto& t = sheet.mesh.triangles[k];
      Vec3 middle;
      double u = 0, v = 0;
      for (const std::uint32_t i : t) {
        middle +=
            Vec3{static_cast<double>(sheet.mesh.points[i][0]), static_cast<double>(sheet.mesh.points[i][1]),
                 static_cast<double>(sheet.mesh.points[i][2])} *
            (1 / 3.0);
        u += static_cast<double>(sheet.paper_mm[i][0]) / 3,
            v += static_cast<double>(sheet.paper_mm[i][1]) / 3;
      }
      EXPECT_LT(length(bent(bend, u, v) - middle), 0.01);
    }
  }
}

TEST(SheetScene, ShowsItsPictureTheRightWayRoundAtItsDistance) {
  SheetOptions o;
  o.width_mm = 150;
  o.look.screen = true;
  const auto made = make_sheet_scene(flag(), o);
  ASSERT_TRUE(made);
  const auto hit = [&](double x, double y) { return (*made)->look({0, 0, 0}, normalised({x, y, 560})); };
  const RayHit red = hit(-40, -30), green = hit(40, -30), blue = hit(0, 80), beside = hit(90, 0);
  EXPECT_GT(red.light.x, 10 * red.light.y);
  EXPECT_GT(green.light.y, 10 * green.light.x);
  EXPECT_GT(blue.light.z, 10 * blue.light.x);
  EXPECT_NEAR(red.distance_mm, std::hypot(560, 40, 30), 1e-3);
  EXPECT_EQ(beside.body, -1);
}

TEST(SheetScene, PaperIsLitAndGlassMirrorsTheLamps) {
  Picture white = flag();
  for (std::byte& b : white.bytes) b = std::byte{255};
  SheetOptions o;
  const auto light = [&](double share) {
    o.lamps = {share, share, share};
    const auto scene = make_sheet_scene(white, o);
    return (*scene)->look({0, 0, 0}, {0, 0, 1}).light.y;
  };
  const double usual = light(1), dim = light(0.3);
  EXPECT_GT(usual, 0.3);
  EXPECT_LT(usual, 1);
  EXPECT_LT(dim, 0.6 * usual);

  // Turned so that the left panel stands in the mirror: half way between the camera and the panel.
  o.look = {true, 0.5, 0.04, 0.02};
  o.lamps = {};
  const Vec3 to_panel = normalised(Vec3{-330, -190, 40} - Vec3{0, 0, 560}),
             normal = normalised(to_panel + Vec3{0, 0, -1});
  const auto scene_turned = [&](double yaw, double pitch) {
    o.pose.yaw_deg = yaw, o.pose.pitch_deg = pitch;
    return (*make_sheet_scene(white, o))->look({0, 0, 0}, {0, 0, 1}).light.y;
  };
  const double yaw = std::asin(normal.x) * 57.29577951308232,
               pitch = std::atan2(normal.y, -normal.z) * 57.29577951308232;
  EXPECT_GT(scene_turned(yaw, pitch), scene_turned(-20, 15) + 0.3);
}

TEST(SheetScene, RefusesWhatNoHandCouldHold) {
  SheetOptions o;
  o.bend.radius_mm = 10;
  EXPECT_FALSE(make_sheet_scene(flag(), o));
  o.bend = {100, 0, 300, 100};
  EXPECT_FALSE(make_sheet_scene(flag(), o));
  o.bend = {};
  o.width_mm = 0;
  EXPECT_FALSE(make_sheet_scene(flag(), o));
  EXPECT_FALSE(make_sheet_scene(Picture{}, {}));
}

}  // namespace
}  // namespace relievo::hal::sim

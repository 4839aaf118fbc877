// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/reconstruct/face_crop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

// A dome of 70 mm radius with its top at 500 mm, on a wall at 570 mm; 0.5 mm a pixel.
constexpr double kNoseMm = 25, kTipMm = 500 - kNoseMm;

// And a nose on the dome.
PointCloud dome_on_a_wall(std::pmr::memory_resource* memory) {
  PointCloud cloud(memory);
  cloud.lattice_step_px = 4;
  for (int y = 0; y < 1000; y += 4)
    for (int x = 0; x < 1000; x += 4) {
      const double u = 0.5 * (x - 500);
      const double v = 0.5 * (y - 500);
      const double r2 = u * u + v * v;
      const double nose = std::max(0.0, kNoseMm * (1 - std::sqrt(r2) / 20));
      const double z = (r2 < 4900 ? 570 - std::sqrt(4900 - r2) : 570) - nose;
      cloud.points.push_back({{static_cast<float>(u), static_cast<float>(v), static_cast<float>(z)},
                              {static_cast<float>(x), static_cast<float>(y)},
                              0.1F});
    }
  return cloud;
}

RectifiedPair pair_with_face(double width_px) {
  RectifiedPair pair(std::pmr::get_default_resource());
  pair.face_centre_px = {510, 490};
  pair.face_width_px = width_px;
  return pair;
}

TEST(FaceCrop, KeepsTheBallAroundTheTipOfTheNose) {
  test::StageFixture fixture(1 << 24, 1 << 22, 1);
  PointCloud cloud = dome_on_a_wall(&fixture.output);
  ASSERT_TRUE(crop_to_face(cloud, pair_with_face(300), {.radius_mm = 110}, fixture.context));
  double farthest = 0;
  for (const CloudPoint& p : cloud.points)
    farthest = std::max(farthest, std::sqrt(p.at_mm.x * p.at_mm.x + p.at_mm.y * p.at_mm.y +
                                            (p.at_mm.z - kTipMm) * (p.at_mm.z - kTipMm)));
  EXPECT_GT(farthest, 107);
  EXPECT_LT(farthest, 113);
}

// Bowed, the forehead is nearest; the ball stays about the nose.
TEST(FaceCrop, ABowedHeadKeepsItsChin) {
  test::StageFixture fixture(1 << 24, 1 << 22, 1);
  PointCloud cloud = dome_on_a_wall(&fixture.output);
  const double slope = std::tan(20 * std::numbers::pi / 180);
  for (CloudPoint& p : cloud.points)
    p.at_mm.z += static_cast<float>(slope * static_cast<double>(p.at_mm.y));  // what is higher is nearer
  ASSERT_TRUE(crop_to_face(cloud, pair_with_face(300), {.radius_mm = 80}, fixture.context));
  double lowest = 0;
  for (const CloudPoint& p : cloud.points) lowest = std::max(lowest, static_cast<double>(p.at_mm.y));
  EXPECT_GT(lowest, 40);
}

TEST(FaceCrop, OneStrayPointDoesNotMoveTheBall) {
  test::StageFixture fixture(1 << 24, 1 << 22, 1);
  PointCloud cloud = dome_on_a_wall(&fixture.output);
  cloud.points.push_back({{30, 30, 420}, {560, 560}, 0.1F});
  ASSERT_TRUE(crop_to_face(cloud, pair_with_face(300), {.radius_mm = 60}, fixture.context));
  for (const CloudPoint& p : cloud.points) EXPECT_GT(p.at_mm.z, 450);
}

// What a window matches falsely lies anywhere between the cameras and the room: a seventh of it, half of that
// nearer than any nose.
TEST(FaceCrop, AThousandFalseMatchesDoNotMoveTheBall) {
  test::StageFixture fixture(1 << 24, 1 << 22, 1);
  PointCloud cloud = dome_on_a_wall(&fixture.output);
  PointCloud undisturbed = dome_on_a_wall(&fixture.output);
  for (std::size_t k = 0; k < cloud.points.size(); k += 7)
    cloud.points[k].at_mm.z = 250 + float(k * 2'654'435'761U % 1000);
  for (PointCloud* each : {&cloud, &undisturbed})
    ASSERT_TRUE(crop_to_face(*each, pair_with_face(300), {.radius_mm = 60}, fixture.context));
  EXPECT_GT(cloud.points.size(), undisturbed.points.size() * 3 / 4);
}

TEST(FaceCrop, LeavesEverythingWhereNoFaceWasLookedFor) {
  test::StageFixture fixture(1 << 24, 1 << 22, 1);
  PointCloud cloud = dome_on_a_wall(&fixture.output);
  const std::size_t before = cloud.points.size();
  ASSERT_TRUE(crop_to_face(cloud, pair_with_face(0), {}, fixture.context));
  EXPECT_EQ(cloud.points.size(), before);
}

TEST(FaceCrop, NothingInTheMiddleIsNoFace) {
  test::StageFixture fixture(1 << 20, 1 << 20, 1);
  PointCloud cloud(&fixture.output);
  const auto cropped = crop_to_face(cloud, pair_with_face(300), {}, fixture.context);
  ASSERT_FALSE(cropped);
  EXPECT_EQ(cropped.error().code, Errc::NoFace);
}

}  // namespace
}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/held_board.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/small_rig.h"

namespace relievo::tests {
namespace {

using namespace relievo::hal::sim;

const RigOptions kRig = test::small_rig(0.25);

SensorOptions quiet() {
  SensorOptions sensor;
  sensor.noise = 0;
  sensor.gamma = false;
  return sensor;
}

BodyPose at(double right_mm, double about_y = 0.3) {
  BodyPose pose;
  pose.world_from_body = rotation(0.2, about_y, 0.1);
  pose.origin_mm = Vec3{right_mm, 0, 620} - pose.world_from_body * Vec3{90, 60, 0};
  return pose;
}

int level(const hal::Picture& picture, Pixel p) {
  return std::to_integer<int>(
      picture.bytes[static_cast<std::size_t>(std::lround(p.y)) * static_cast<std::size_t>(picture.width_px) +
                    static_cast<std::size_t>(std::lround(p.x))]);
}

TEST(HeldBoard, IsHeldAsSaid) {
  const BoardPattern pattern;
  const double right = (pattern.corners_x - 1) * pattern.square_mm,
               down = (pattern.corners_y - 1) * pattern.square_mm;
  const auto depth = [&](const HeldPlace& place, double x, double y) {
    return place.pose(pattern).to_world({x, y, 0}).z;
  };
  const Vec3 middle = HeldPlace{30, -20, 600, 10, 20, 30}.pose(pattern).to_world({right / 2, down / 2, 0});
  EXPECT_NEAR(length(middle - Vec3{30, -20, 600}), 0, 1e-9);
  const HeldPlace yaw{0, 0, 600, 10, 0, 0}, pitch{0, 0, 600, 0, 10, 0}, roll{0, 0, 600, 0, 0, 10};
  EXPECT_LT(depth(yaw, 0, down / 2), depth(yaw, right, down / 2)) << "left edge nearer";
  EXPECT_LT(depth(pitch, right / 2, 0), depth(pitch, right / 2, down)) << "upper edge nearer";
  EXPECT_GT(roll.pose(pattern).to_world({right, down / 2, 0}).y, 0) << "clockwise in the picture";
}

TEST(HeldBoard, IsSeenWhereTheRigProjectsIt) {
  HeldBoard board(kRig, {}, quiet(), 2);
  const BodyPose pose = at(0);
  const auto pair = board.photograph(pose, pose, 1);
  for (int row = -1; row < 7; ++row)
    for (int column = -1; column < 10; ++column) {
      const Vec3 middle = pose.to_world({20 * (column + 0.5), 20 * (row + 0.5), 0});
      const bool dark = (row + column) % 2 == 0;
      const int left = level(pair.left, board.rig().left.project(middle));
      const int right = level(pair.right, board.rig().right.project(middle));
      EXPECT_TRUE(dark ? left < 15 : left > 100) << row << ' ' << column << ' ' << left;
      EXPECT_TRUE(dark ? right < 15 : right > 100) << row << ' ' << column << ' ' << right;
    }
}

TEST(HeldBoard, ALineBetweenDarkAndBrightIsInTheMiddleOfItsBlur) {
  HeldBoard board(kRig, {}, quiet(), 2);
  const BodyPose pose = at(0, 0);
  BodyPose closed = pose;
  closed.origin_mm.x += 8;  // 10 px
  const auto still = board.photograph(pose, pose, 1);
  const auto moved = board.photograph(pose, closed, 1);
  const Vec3 edge = pose.to_world({40, 30, 0});  // between a dark square and a bright one
  const auto around = [&](const hal::Picture& picture, double mm) {
    return level(picture, board.rig().left.project(edge + Vec3{mm, 0, 0}));
  };
  EXPECT_GT(std::abs(around(still.left, 2) - around(still.left, -2)), 90) << "sharp";
  EXPECT_LT(std::abs(around(moved.left, 6) - around(moved.left, 2)), 90) << "smeared";
  const double middle = 0.5 * (around(moved.left, 4 - 9) + around(moved.left, 4 + 9));
  EXPECT_NEAR(around(moved.left, 4), middle, 12) << "half of the exposure on either side";
}

TEST(HeldBoard, TheSameSeedGivesTheSamePicturesWithAnyNumberOfThreads) {
  SensorOptions sensor;
  HeldBoard one(kRig, {}, sensor, 1);
  HeldBoard two(kRig, {}, sensor, 2);
  const auto a = one.photograph(at(-10), at(-9), 5);
  const auto b = two.photograph(at(-10), at(-9), 5);
  const auto c = two.photograph(at(-10), at(-9), 6);
  EXPECT_EQ(a.left.bytes, b.left.bytes);
  EXPECT_EQ(a.right.bytes, b.right.bytes);
  EXPECT_NE(b.left.bytes, c.left.bytes) << "new noise";
  EXPECT_NE(a.left.bytes, a.right.bytes);
}

// Noise of one row must not come back in the next, shifted: it would be structure.
TEST(HeldBoard, NoiseHasNoStripes) {
  SensorOptions sensor;
  sensor.gamma = false;
  HeldBoard board(kRig, {}, sensor, 2);
  BodyPose away = at(0);
  away.origin_mm.x += 2000;
  const auto picture = board.photograph(away, away, 3).left;
  for (const int shift : {-1, 0, 1}) {
    double sum = 0, squares = 0, mean = 0;
    for (const std::byte v : picture.bytes) mean += std::to_integer<int>(v);
    mean /= static_cast<double>(picture.bytes.size());
    for (int y = 0; y + 1 < picture.height_px; ++y)
      for (int x = 1; x + 1 < picture.width_px; ++x) {
        const double a = level(picture, {static_cast<double>(x), static_cast<double>(y)}) - mean;
        sum += a * (level(picture, {static_cast<double>(x + shift), static_cast<double>(y + 1)}) - mean);
        squares += a * a;
      }
    EXPECT_GT(squares, 0);
    EXPECT_LT(std::abs(sum / squares), 0.02) << shift;
  }
}

TEST(HeldBoard, BesideThePicturesItIsNotSeen) {
  HeldBoard board(kRig, {}, quiet(), 2);
  BodyPose away = at(0);
  away.origin_mm.x += 2000;
  const auto pair = board.photograph(away, away, 1);
  const auto first = pair.left.bytes.front();
  EXPECT_TRUE(
      std::all_of(pair.left.bytes.begin(), pair.left.bytes.end(), [&](std::byte v) { return v == first; }));
}

}  // namespace
}  // namespace relievo::tests

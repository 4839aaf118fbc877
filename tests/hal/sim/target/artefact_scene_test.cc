// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The acceptance artefacts: rays meet what the certificate says, and pictures of them can be matched.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "hal/sim/base/noise.h"
#include "hal/sim/render.h"
#include "hal/sim/target/target_photo.h"

namespace relievo::hal::sim {
namespace {

BodyPose turned() { return ArtefactPlace{12, -7, 560, 15, 25, 40}.pose(); }

TargetPhotoOptions small_photo() {
  TargetPhotoOptions o;
  o.rig.width_px = 480;
  o.rig.height_px = 300;
  return o;
}

TEST(DumbbellScene, EveryPointMetLiesOnASphereOrTheRod) {
  const Dumbbell dumbbell;
  const DumbbellScene scene(dumbbell, turned());
  EXPECT_NEAR(length(scene.centre_mm(1) - scene.centre_mm(0)), dumbbell.spacing_mm, 1e-9);
  Random random(5);
  int spheres = 0, rods = 0;
  for (int k = 0; k < 20000; ++k) {
    const Vec3 ray = normalised(Vec3{random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 1});
    SolidPoint s;
    if (!scene.solid({0, 0, 0}, ray, s)) continue;
    EXPECT_LT(dot(s.normal, ray), 0);
    const Vec3 p = turned().to_body(s.point);
    const double to_sphere =
        std::min(length(s.point - scene.centre_mm(0)), length(s.point - scene.centre_mm(1)));
    if (s.skin) {
      ++spheres;
      EXPECT_NEAR(to_sphere, dumbbell.diameter_mm / 2, 1e-6);
    } else {
      ++rods;
      EXPECT_NEAR(std::hypot(p.y, p.z), dumbbell.rod_radius_mm, 1e-6);
      EXPECT_GT(to_sphere, dumbbell.diameter_mm / 2 - 1e-6);
    }
  }
  EXPECT_GT(spheres, 500);
  EXPECT_GT(rods, 50);
}

TEST(DumbbellScene, OneSphereHidesWhatIsBehindIt) {
  const DumbbellScene scene(Dumbbell{}, ArtefactPlace{0, 0, 560, 0, 90, 0}.pose());  // one before the other
  const Vec3 front = scene.centre_mm(0).z < scene.centre_mm(1).z ? scene.centre_mm(0) : scene.centre_mm(1);
  SolidPoint s;
  ASSERT_TRUE(scene.solid({0, 0, 0}, {0, 0, 1}, s));
  EXPECT_NEAR(s.point.z, front.z - 30, 1e-6);
  EXPECT_TRUE(scene.blocked({0, 0, 700}, {0, 0, -1}, 700));
  EXPECT_FALSE(scene.blocked({0, 0, 400}, {0, 0, -1}, 400));
}

TEST(PlateScene, IsFlatAndEnds) {
  const PlateScene scene(FlatPlate{}, turned());
  SolidPoint s;
  for (const double x : {-119.9, 0.0, 119.9})
    for (const double y : {-89.9, 0.0, 89.9}) {
      const Vec3 at = turned().to_world({x, y, 0});
      ASSERT_TRUE(scene.solid({0, 0, 0}, normalised(at), s));
      EXPECT_LT(length(s.point - at), 1e-6);
    }
  EXPECT_FALSE(scene.solid({0, 0, 0}, normalised(turned().to_world({120.1, 0, 0})), s));
  EXPECT_FALSE(scene.solid({0, 0, 0}, normalised(turned().to_world({0, 90.1, 0})), s));
}

TEST(Speckle, IsThereAtEverySizeAndDiffersFromSeedToSeed) {
  double squares = 0, sum = 0, other = 0;
  constexpr int kCount = 20000;
  Random random(3);
  for (int k = 0; k < kCount; ++k) {
    const Vec3 p{random.uniform(-80, 80), random.uniform(-60, 60), 0};
    const double v = speckle(p, 1);
    ASSERT_GT(v, 0.05);
    ASSERT_LT(v, 0.8);
    sum += v;
    squares += v * v;
    other += v * speckle(p, 2);
  }
  const double mean = sum / kCount, variance = squares / kCount - mean * mean;
  EXPECT_GT(std::sqrt(variance), 0.2);                                // strong
  EXPECT_LT(std::abs(other / kCount - mean * mean), 0.1 * variance);  // and another one
  EXPECT_GT(mean, 0.25);
  EXPECT_LT(mean, 0.55);  // half ink, half paper
}

// Grey levels of the picture inside the plate's middle, for what a matcher can work with.
TEST(TargetPhotos, AreNeitherBlackNorBurntOut) {
  const auto pair = photograph_plate(small_photo(), FlatPlate{}, {});
  ASSERT_TRUE(pair);
  for (const Picture* picture : {&pair->left, &pair->right}) {
    int burnt = 0, dark = 0, light = 0, count = 0;
    for (int y = 110; y < 190; ++y)
      for (int x = 180; x < 300; ++x) {
        const auto level =
            static_cast<int>(picture->bytes[3 * static_cast<std::size_t>(y * picture->width_px + x) + 1]);
        burnt += level > 250;
        dark += level < 130;
        light += level > 170;
        ++count;
      }
    EXPECT_LT(burnt, count / 200);
    EXPECT_GT(dark, count / 10);
    EXPECT_GT(light, count / 10);
  }
}

TEST(TargetPhotos, TheSameNumbersGiveTheSamePicture) {
  const auto a = photograph_dumbbell(small_photo(), Dumbbell{}, {}),
             b = photograph_dumbbell(small_photo(), Dumbbell{}, {});
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->left.bytes, b->left.bytes);
  TargetPhotoOptions other = small_photo();
  other.seed = 2;
  const auto c = photograph_dumbbell(other, Dumbbell{}, {});
  ASSERT_TRUE(c);
  EXPECT_NE(a->left.bytes, c->left.bytes);
}

TEST(TargetPhotos, WhatTheRigDoesNotSeeWholeIsRefused) {
  EXPECT_EQ(photograph_dumbbell(small_photo(), Dumbbell{}, {150, 0, 560, 0, 0, 0}).error().code,
            Errc::PoorGeometry);
  EXPECT_EQ(photograph_plate(small_photo(), FlatPlate{}, {0, 120, 560, 0, 0, 0}).error().code,
            Errc::PoorGeometry);
  EXPECT_EQ(photograph_board(small_photo(), {40, 40, 20}, 0, 4).error().code, Errc::PoorGeometry);
  EXPECT_EQ(photograph_dumbbell(small_photo(), Dumbbell{60, 50}, {}).error().code, Errc::InvalidInput);
  EXPECT_EQ(photograph_plate(small_photo(), FlatPlate{5, 5}, {}).error().code, Errc::InvalidInput);
}

}  // namespace
}  // namespace relievo::hal::sim

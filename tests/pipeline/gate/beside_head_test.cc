// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/head/head_outline.h"
#include "pipeline/gate/judgement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/pipeline/gate/seen_relief.h"

namespace relievo::pipeline {
namespace {

// A head of 75 x 100 mm whose tip of the nose is at pixel (tip_x, 140), and what `beside` puts about it.
double share_beside(const Depth& beside, double tip_x = 240) {
  SeenRelief work(480, 300, {240, 150});
  Relief& relief = work.relief;
  for (int y = 0; y < relief.height_px; ++y)
    for (int x = 0; x < relief.width_px; ++x) {
      const double right = (x - tip_x) * kFaceDistanceMm / kFocalPx,
                   down = (y - 140) * kFaceDistanceMm / kFocalPx;
      const double rim = right * right / (75 * 75) + down * down / (100 * 100);
      const double z = rim < 1 ? kFaceDistanceMm + 60 * rim * rim : beside ? beside(right, down) : 0;
      relief.depth_mm[relief.index(x, y)] = static_cast<float>(z);
    }
  label_surfaces(relief, work.context);
  HeadMeasurement head;
  head.known = true;
  head.tip_mm = relief.point(tip_x, 140.0, kFaceDistanceMm);
  return beside_share(relief, head);
}

// From `near` to `far` aside of the tip, to the picture's right where positive.
Depth plate(double near_mm, double far_mm, double z) {
  return [=](double right, double down) {
    return right > near_mm && right < far_mm && std::abs(down + 30) < 60 ? z : 0;
  };
}

TEST(BesideHead, AHeadAloneHasNothingBesideIt) { EXPECT_EQ(share_beside({}), 0); }

TEST(BesideHead, WhatStandsLevelWithTheFaceIsMeasuredOnEitherSide) {
  EXPECT_GT(share_beside(plate(90, 190, kFaceDistanceMm + 60)), 0.8);
  EXPECT_GT(share_beside(plate(-190, -90, kFaceDistanceMm - 60)), 0.8);
  const double half = share_beside(plate(90, 130, kFaceDistanceMm + 60));  // to 144 mm aside where it stands
  EXPECT_GT(half, 0.3);
  EXPECT_LT(half, 0.7);
}

TEST(BesideHead, WhatLiesBehindTheHeadOrFarBeforeItDoesNoHarm) {
  EXPECT_EQ(share_beside(plate(90, 190, kFaceDistanceMm + kBesideBehindMm + 40)), 0);
  EXPECT_EQ(share_beside([](double, double) { return kFaceDistanceMm + 300.0; }), 0) << "a wall";
  EXPECT_EQ(share_beside(plate(90, 190, kFaceDistanceMm - kBesideBeforeMm - 20)), 0) << "a lamp's arm";
}

// Hair goes on from the head without a step, however wide.
TEST(BesideHead, TheHeadsOwnHairIsNotBesideIt) {
  EXPECT_EQ(share_beside([](double right, double down) {
              return down < -20 && std::abs(right) < 190 ? kFaceDistanceMm + 60 : 0;
            }),
            0);
}

// A bag held against the ear goes on from the head as well, but no hair fills the field.
TEST(BesideHead, WhatTouchesTheHeadIsBesideItWhereNoHairWouldBe) {
  EXPECT_GT(share_beside([](double right, double down) {
              return right > 60 && right < 200 && std::abs(down + 30) < 85 ? kFaceDistanceMm + 60 : 0;
            }),
            GateLimits{}.beside_share);
}

// Of a field out of the picture nothing can be said; the other one speaks.
TEST(BesideHead, AFieldOutOfThePictureIsLeftOut) {
  const Depth everywhere = [](double right, double down) {
    return std::abs(right) > 90 && std::abs(down + 30) < 60 ? kFaceDistanceMm + 60 : 0;
  };
  EXPECT_GT(share_beside(everywhere, 80), 0.8);
  EXPECT_EQ(share_beside(plate(-190, -90, kFaceDistanceMm + 60), 80), 0);
}

}  // namespace
}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/head/head_outline.h"
#include "pipeline/gate/judgement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "pipeline/base/workspace.h"
#include "pipeline/gate/relief/live_relief.h"

namespace relievo::pipeline {
namespace {

constexpr int kWidth = 480, kHeight = 300;
constexpr double kFocalPx = 737, kFaceMm = 540;

// Depth at millimetres right and down of the tip of the nose, at the depth of the face; 0: nothing known.
using Depth = std::function<double(double right, double down)>;

// A head of 75 x 100 mm whose tip of the nose is at pixel (tip_x, 140), and what `beside` puts about it.
double share_with(const Depth& beside, double tip_x = 240) {
  Workspace work(1, std::size_t{8} << 20, std::size_t{32} << 20);
  Relief relief(&work.output);
  relief.width_px = kWidth, relief.height_px = kHeight;
  relief.focal_px = kFocalPx, relief.baseline_mm = 140, relief.centre_px = {kWidth / 2.0, kHeight / 2.0};
  const std::size_t count = std::size_t{kWidth} * kHeight;
  relief.depth_mm.resize(count);
  relief.surface.resize(count);
  relief.grey.resize(count);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double right = (x - tip_x) * kFaceMm / kFocalPx, down = (y - 140) * kFaceMm / kFocalPx;
      const double rim = right * right / (75 * 75) + down * down / (100 * 100);
      const double z = rim < 1 ? kFaceMm + 60 * rim * rim : beside ? beside(right, down) : 0;
      relief.depth_mm[relief.index(x, y)] = static_cast<float>(z);
    }
  label_surfaces(relief, 1.5F, 400, work.context);
  HeadMeasurement head;
  head.known = true;
  head.tip_mm = relief.point(tip_x, 140.0, kFaceMm);
  return beside_share(relief, head);
}

// From `near` to `far` aside of the tip, to the picture's right where positive.
Depth plate(double near_mm, double far_mm, double z) {
  return [=](double right, double down) {
    return right > near_mm && right < far_mm && std::abs(down + 30) < 60 ? z : 0;
  };
}

TEST(BesideHead, AHeadAloneHasNothingBesideIt) { EXPECT_EQ(share_with({}), 0); }

TEST(BesideHead, WhatStandsLevelWithTheFaceIsMeasuredOnEitherSide) {
  EXPECT_GT(share_with(plate(90, 190, kFaceMm + 60)), 0.8);
  EXPECT_GT(share_with(plate(-190, -90, kFaceMm - 60)), 0.8);
  const double half = share_with(plate(90, 130, kFaceMm + 60));  // to 144 mm aside where it stands
  EXPECT_GT(half, 0.3);
  EXPECT_LT(half, 0.7);
}

TEST(BesideHead, WhatLiesBehindTheHeadOrFarBeforeItDoesNoHarm) {
  EXPECT_EQ(share_with(plate(90, 190, kFaceMm + kBesideBehindMm + 40)), 0);
  EXPECT_EQ(share_with([](double, double) { return kFaceMm + 300.0; }), 0) << "a wall";
  EXPECT_EQ(share_with(plate(90, 190, kFaceMm - kBesideBeforeMm - 20)), 0) << "a lamp's arm";
}

// Hair goes on from the head without a step, however wide.
TEST(BesideHead, TheHeadsOwnHairIsNotBesideIt) {
  EXPECT_EQ(share_with([](double right, double down) {
              return down < -20 && std::abs(right) < 190 ? kFaceMm + 60 : 0;
            }),
            0);
}

// A bag held against the ear goes on from the head as well, but no hair fills the field.
TEST(BesideHead, WhatTouchesTheHeadIsBesideItWhereNoHairWouldBe) {
  EXPECT_GT(share_with([](double right, double down) {
              return right > 60 && right < 200 && std::abs(down + 30) < 85 ? kFaceMm + 60 : 0;
            }),
            GateLimits{}.beside_share);
}

// Of a field out of the picture nothing can be said; the other one speaks.
TEST(BesideHead, AFieldOutOfThePictureIsLeftOut) {
  const Depth everywhere = [](double right, double down) {
    return std::abs(right) > 90 && std::abs(down + 30) < 60 ? kFaceMm + 60 : 0;
  };
  EXPECT_GT(share_with(everywhere, 80), 0.8);
  EXPECT_EQ(share_with(plate(-190, -90, kFaceMm + 60), 80), 0);
}

}  // namespace
}  // namespace relievo::pipeline

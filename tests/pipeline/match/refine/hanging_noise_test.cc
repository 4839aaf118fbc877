// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Noise that hangs together is told from noise that does not, whatever its size.
#include <gtest/gtest.h>

#include <random>

#include "pipeline/match/image/plane_filters.h"
#include "pipeline/match/refine/surface_refiner.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

constexpr int kHangingSide = 240;

// Residuals of so many grey levels summed over (2 box + 1)^2 pixels, gradients over 3 x 3.
float hanging(int box, float grey, bool masked = false) {
  test::StageFixture fixture{std::size_t{16} << 20, std::size_t{16} << 20};
  WarpTerms terms(&fixture.output, kHangingSide, kHangingSide);
  Plane<float> across(&fixture.output, kHangingSide, kHangingSide);
  std::mt19937 random(11);
  std::normal_distribution<float> normal(0, 1);
  for (float& r : terms.residual.values) r = grey * normal(random);
  for (float& g : terms.gradient.values) g = normal(random);
  const auto smooth = [&](Plane<float>& plane, int radius) {
    box_sum(plane, radius, fixture.context.pool, across, plane);
    for (float& v : plane.values) v /= static_cast<float>(2 * radius + 1);
  };
  if (box > 0) smooth(terms.residual, box);
  smooth(terms.gradient, 1);
  for (float& m : terms.mask.values) m = masked ? 0.0F : 1.0F;
  return hanging_noise(terms, fixture.context.pool);
}

TEST(HangingNoise, WhiteNoiseStandsAlone) {
  EXPECT_EQ(hanging(0, 0.5F), 1);
  EXPECT_EQ(hanging(0, 3), 1);
}

// Sum of both triangles' product over the shifts of 3 x 3: ((1 + 2 (2/3)^2 + 2 (1/3)^2))^2 = 4.46, over 1.6.
TEST(HangingNoise, WhatHangsTogetherCountsByHowFar) {
  EXPECT_NEAR(hanging(1, 1), 4.46 / 1.6, 0.25);
  EXPECT_NEAR(hanging(1, 3), 4.46 / 1.6, 0.25);
  EXPECT_GT(hanging(2, 1), hanging(1, 1));
}

TEST(HangingNoise, WithoutAnythingToSeeItIsOne) { EXPECT_EQ(hanging(1, 1, true), 1); }

}  // namespace
}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/quality/quality.h"

#include <gtest/gtest.h>

#include "tests/pipeline/calibrate/predicted_error.h"
#include "tests/support/proof.h"

namespace relievo::tests {
namespace {

// A smoke of what tests/bench/calibration_coverage proves with 600 rigs: bounds are three standard
// errors of so few cases wide.
TEST(CalibrationUncertainty, TheTrueErrorLiesInThePredictedBand) {
  RELIEVO_MANY_TRIALS();
  PredictedError error;
  for (unsigned seed = 1; seed <= 40; ++seed)
    ASSERT_TRUE(error.add(seed, seed % 2 == 0 ? 0.05 : 0.2, 6 + static_cast<int>(seed % 10)));
  for (const Band* band : {&error.near, &error.face, &error.far, &error.scale, &error.projection}) {
    EXPECT_GE(band->share_95(), 0.85) << band->name;
    EXPECT_GE(band->share_one(), 0.5) << band->name;
    EXPECT_LE(band->share_one(), 0.86) << band->name;
  }
  EXPECT_LE(error.left_out, error.given / 100);
}

TEST(CalibrationUncertainty, MoreViewsAreKnownBetterAndNoiseWorse) {
  const auto sigma = [](double noise_px, int views) {
    BoardSimulator boards(SimulatedRig{}, noise_px, 77);
    boards.add(views);
    const auto done = pipeline::calibrate(boards.input());
    return done ? done->quality.uncertainty.depth[3].sigma_mm : -1.0;
  };
  const double usual = sigma(0.1, 8);
  ASSERT_GT(usual, 0);
  EXPECT_LT(sigma(0.1, 24), 0.75 * usual);
  EXPECT_GT(sigma(0.3, 8), 2 * usual);
}

// On a rig that shakes between the views the corners' noise would promise too much.
TEST(CalibrationUncertainty, SaysSoWhenTheRigSlips) {
  const auto uncertainty = [](double turn_rad) {
    BoardSimulator boards(SimulatedRig{}, 0.05, 78);
    for (int i = 0; i < 16; ++i) {
      Slip slip;
      for (double& turn : slip.turn) turn = boards.normal(turn_rad);
      boards.add(slip);
    }
    return pipeline::calibrate(boards.input())->quality.uncertainty;
  };
  const auto firm = uncertainty(0);
  const auto loose = uncertainty(0.0006);
  EXPECT_FALSE(firm.slips);
  EXPECT_TRUE(loose.slips);
  EXPECT_GT(loose.depth[3].sigma_mm, 3 * firm.depth[3].sigma_mm);
}

}  // namespace
}  // namespace relievo::tests

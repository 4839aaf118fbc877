// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/epipolar/row_aligner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace relievo::pipeline {
namespace {

// 30 x 36 places, 16 px apart, under a known field.
struct Places {
  double offset = 0.3, slope_x = 4e-4, slope_y = -2e-4;
  std::vector<LocalShift> locals;

  Places(std::mt19937& random, double noise, double block_noise) {
    std::normal_distribution<double> normal(0, 1);
    std::vector<double> together(kShiftBlocks);
    for (double& v : together) v = block_noise * normal(random);
    for (int j = 0; j < 36; ++j)
      for (int i = 0; i < 30; ++i) {
        const int block = i / 5 + kShiftBlocksAcross * (j / 6);
        const double x = 700 + 16 * i, y = 300 + 16 * j;
        // Those with less information are noisier, as in life.
        const double information = i % 3 == 0 ? 100 : 900;
        const double sigma = noise * std::sqrt(900 / information);
        locals.push_back({x, y, at(x, y) + sigma * normal(random) + together[static_cast<std::size_t>(block)],
                          information, block});
      }
  }
  double at(double x, double y) const { return offset + slope_x * (x - 930) + slope_y * (y - 570); }
};

class ShiftField : public testing::Test {
 protected:
  std::vector<std::byte> block_ = std::vector<std::byte>(1 << 20);
  Arena scratch_{block_};
  std::mt19937 random_{7};
};

TEST_F(ShiftField, FindsAPerfectField) {
  const Places places(random_, 0, 0);
  const EpipolarShift shift = fit_shift_field(places.locals, true, scratch_);
  ASSERT_TRUE(shift.measured());
  EXPECT_NEAR(shift.at(930, 570), 0.3, 1e-9);
  EXPECT_NEAR(shift.slope_x, 4e-4, 1e-12);
  EXPECT_NEAR(shift.slope_y, -2e-4, 1e-12);
  double square = 0;
  for (const LocalShift& at : places.locals)
    square += places.at(at.x_px, at.y_px) * places.at(at.x_px, at.y_px);
  EXPECT_NEAR(shift.residual_px, std::sqrt(square / 1080), 0.01);
  EXPECT_EQ(scratch_.used(), 0U);
}

// The errors of the field are what its covariance says, with neighbours that err alone and together.
TEST_F(ShiftField, SaysHowSureItIs) {
  for (const double block_noise : {0.0, 0.15}) {
    double normalised = 0;
    constexpr int kTrials = 300;
    for (int trial = 0; trial < kTrials; ++trial) {
      const Places places(random_, 0.3, block_noise);
      const EpipolarShift shift = fit_shift_field(places.locals, true, scratch_);
      const double error = shift.offset_px - places.at(shift.middle_x_px, shift.middle_y_px);
      normalised += error * error / shift.covariance_px2[0];
    }
    EXPECT_NEAR(normalised / kTrials, 1, 0.35) << block_noise;
  }
}

TEST_F(ShiftField, AFifthOfLiarsDoNotMoveIt) {
  Places places(random_, 0.1, 0);
  for (std::size_t k = 0; k < places.locals.size(); k += 5) {
    places.locals[k].shift_px += 2;
    places.locals[k].information = 5000;  // and sure of themselves
  }
  const EpipolarShift shift = fit_shift_field(places.locals, true, scratch_);
  EXPECT_NEAR(shift.offset_px, places.at(shift.middle_x_px, shift.middle_y_px),
              4 * std::sqrt(shift.covariance_px2[0]));
  EXPECT_LT(shift.sigma_px, 0.02);
}

TEST_F(ShiftField, TooLittleIsNotMeasured) {
  const Places places(random_, 0.1, 0);
  EXPECT_FALSE(fit_shift_field({}, true, scratch_).measured());
  EXPECT_FALSE(fit_shift_field(std::span(places.locals).first(11), true, scratch_).measured());
  EXPECT_FALSE(fit_shift_field(std::span(places.locals).first(150), true, scratch_).measured())
      << "one row of blocks";
}

TEST_F(ShiftField, TwoFieldsAddUp) {
  EpipolarShift first;
  first.offset_px = 0.5, first.slope_x = 1e-3, first.slope_y = 2e-3, first.middle_x_px = 100,
  first.middle_y_px = 50;
  const EpipolarShift second = fit_shift_field(Places(random_, 0.1, 0).locals, true, scratch_);
  const EpipolarShift sum = sum_of(first, second);
  for (const double x : {0.0, 500.0, 1000.0})
    EXPECT_NEAR(sum.at(x, 2 * x), first.at(x, 2 * x) + second.at(x, 2 * x), 1e-9);
  EXPECT_EQ(sum.covariance_px2, second.covariance_px2);
}

}  // namespace
}  // namespace relievo::pipeline

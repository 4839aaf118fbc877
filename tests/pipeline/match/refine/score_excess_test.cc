// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/refine/surface_refiner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "pipeline/match/image/plane_filters.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

using test::StageFixture;

constexpr int kFittedSide = 112;
constexpr int kMargin = 16;

// A fit of noise alone, white or summed over a box, and what it leaves of the noise.
struct Fitted {
  BendingSystem system;
  Plane<float> pull;

  Fitted(StageFixture& fixture, float data, float bend, int box, std::uint32_t seed = 7)
      : system(&fixture.output, kFittedSide, kFittedSide), pull(&fixture.output, kFittedSide, kFittedSide) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal(0, std::sqrt(data));
    for (int y = 1; y < kFittedSide - 1; ++y)
      for (int x = 1; x < kFittedSide - 1; ++x) {
        system.data.row(y)[x] = data;
        system.bend_xx.row(y)[x] = x > 1 && x < kFittedSide - 2 ? bend : 0;
        system.bend_yy.row(y)[x] = y > 1 && y < kFittedSide - 2 ? bend : 0;
        system.bend_xy.row(y)[x] = x < kFittedSide - 2 && y < kFittedSide - 2 ? 2 * bend : 0;
        pull.row(y)[x] = normal(random);
      }
    Plane<float> across(&fixture.output, kFittedSide, kFittedSide);
    if (box > 0) {
      box_sum(pull, box, fixture.context.pool, across, pull);
      const auto side = static_cast<float>(2 * box + 1);
      for (float& v : pull.values) v /= side;  // as loud as before, a pixel
    }
    for (std::size_t k = 0; k < pull.values.size(); ++k)
      system.rhs.values[k] = system.data.values[k] > 0 ? -pull.values[k] : 0.0F;
    Plane<float> fit(&fixture.output, kFittedSide, kFittedSide);
    solve(system, 120, kToTheEnd, fixture.context.pool, fixture.context.scratch, fit);
    for (std::size_t k = 0; k < pull.values.size(); ++k)
      pull.values[k] += system.data.values[k] * fit.values[k];
  }
  double mean_excess(StageFixture& fixture) {
    Plane<float> excess(&fixture.output, kFittedSide, kFittedSide);
    measure_score_excess(system, pull, system.data, 1, fixture.context.pool, fixture.context.scratch, excess);
    EXPECT_GE(*std::min_element(excess.values.begin(), excess.values.end()), 0.5F);
    double sum = 0;
    for (int y = kMargin; y < kFittedSide - kMargin; ++y)
      for (int x = kMargin; x < kFittedSide - kMargin; ++x) sum += static_cast<double>(excess.row(y)[x]);
    return sum / ((kFittedSide - 2 * kMargin) * (kFittedSide - 2 * kMargin));
  }
};

TEST(ScoreExcess, WhiteNoiseHasNone) {
  constexpr std::uint32_t kDraws = 16;  // a lattice holds some twenty blocks: one draw strays by a tenth
  for (const float reach : {0.1F, 0.3F, 0.6F}) {
    double excess = 0;
    for (std::uint32_t seed = 1; seed <= kDraws; ++seed) {
      StageFixture fixture;
      Fitted fitted(fixture, 2, 2 / (reach * reach * reach * reach), 0, seed);
      excess += fitted.mean_excess(fixture) / kDraws;
    }
    EXPECT_NEAR(excess, 1, 0.06) << reach;
  }
}

// Summed over a block, noise whose neighbours are the same counts as often as there are neighbours: nine
// for 3 x 3, less what falls over the block's edge and what the fit follows.
TEST(ScoreExcess, NoiseThatHangsTogetherHasAsMuchAsItHangsTogether) {
  StageFixture fixture;
  Fitted fitted(fixture, 2, 2 / std::pow(0.2F, 4.0F), 1);
  const double excess = fitted.mean_excess(fixture);
  EXPECT_GT(excess, 4.5);
  EXPECT_LT(excess, 9);
}

TEST(ScoreExcess, WhereNothingWasMeasuredItIsOne) {
  StageFixture fixture;
  BendingSystem system(&fixture.output, 32, 32);
  const Plane<float> pull(&fixture.output, 32, 32);
  Plane<float> excess(&fixture.output, 32, 32);
  measure_score_excess(system, pull, system.data, 2, fixture.context.pool, fixture.context.scratch, excess);
  for (const float e : excess.values) ASSERT_EQ(e, 1);
}

}  // namespace
}  // namespace relievo::pipeline

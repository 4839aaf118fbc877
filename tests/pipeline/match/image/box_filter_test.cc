// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/image/plane_filters.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

TEST(BoxSum, EqualsTheSlowTwinForEveryRadius) {
  test::StageFixture fixture(1 << 20, 1 << 20, 3);
  for (const int radius : {0, 1, 3, 7, 40}) {
    Arena::Mark mark(fixture.scratch);
    Plane<float> from(&fixture.scratch, 37, 23), across(&fixture.scratch, 37, 23),
        to(&fixture.scratch, 37, 23);
    std::mt19937 random(9);
    for (float& value : from.values) value = std::uniform_real_distribution<float>(-100, 100)(random);
    box_sum(from, radius, fixture.pool, across, to);
    for (int y = 0; y < 23; ++y)
      for (int x = 0; x < 37; ++x) {
        double sum = 0;
        for (int j = std::max(0, y - radius); j <= std::min(22, y + radius); ++j)
          for (int i = std::max(0, x - radius); i <= std::min(36, x + radius); ++i)
            sum += static_cast<double>(from.row(j)[i]);
        EXPECT_NEAR(static_cast<double>(to.row(y)[x]), sum, 0.02) << radius << " at " << x << "," << y;
      }
  }
}

}  // namespace
}  // namespace relievo::pipeline

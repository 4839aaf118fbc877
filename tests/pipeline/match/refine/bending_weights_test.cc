// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/bending/bending_system.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

constexpr int kSize = 40;
constexpr int kMiddle = kSize / 2;
const BendingExpectation kExpected{.lambda = 100, .crease = 0.07, .wrinkle = 0.017};

struct Weighed {
  test::StageFixture fixture{std::size_t{1} << 20, std::size_t{1} << 20, 2};
  Plane<float> d{&fixture.output, kSize, kSize};
  Plane<std::uint8_t> domain{&fixture.output, kSize, kSize};
  Plane<float> across{&fixture.output, kSize, kSize}, wrinkled{&fixture.output, kSize, kSize};
  BendingSystem system{&fixture.output, kSize, kSize};
  Folds folds{&fixture.output, kSize, kSize};

  explicit Weighed(const std::function<float(int, int)>& surface,
                   const BendingExpectation& expected = kExpected, int fold_row = -1) {
    if (fold_row >= 0) std::fill_n(folds.yy.row(fold_row), kSize, std::uint8_t{255});
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        d.row(y)[x] = surface(x, y);
        domain.row(y)[x] = x > 0 && y > 0 && x < kSize - 1 && y < kSize - 1 ? 1 : 0;
      }
    weigh_bending(d, domain, expected, folds, fixture.pool, across, wrinkled, system);
  }
  float least(int from, int to) const {
    float least = system.bend_xx.row(kMiddle)[from];
    for (int x = from; x <= to; ++x) least = std::min(least, system.bend_xx.row(kMiddle)[x]);
    return least;
  }
};

float wave(int x, float height) {
  return height * std::sin(static_cast<float>(x) * 2 * std::numbers::pi_v<float> / 10);
}

TEST(BendingWeights, APlaneIsHeldWhollyHoweverItTilts) {
  const Weighed tilted(
      [](int x, int y) { return 0.5F * static_cast<float>(x) - 0.25F * static_cast<float>(y); });
  for (int x = 2; x < kSize - 2; ++x) {
    EXPECT_FLOAT_EQ(tilted.system.bend_xx.row(kMiddle)[x], 100);
    EXPECT_FLOAT_EQ(tilted.system.bend_yy.row(kMiddle)[x], 100);
    EXPECT_FLOAT_EQ(tilted.system.bend_xy.row(kMiddle)[x], 200);
  }
}

TEST(BendingWeights, ACreaseIsLetGoWhereItIsAndNowhereElse) {
  const Weighed step([](int x, int) { return x < kMiddle ? 0.0F : 3.0F; });
  EXPECT_LT(step.least(kMiddle - 1, kMiddle), 0.2F);  // 3 px are 43 creases: a two-thousandth
  EXPECT_GT(step.least(kMiddle - 8, kMiddle - 4), 99.0F);
}

TEST(BendingWeights, ReliefIsHeldLessAndNeverLetGo) {
  // A wave of 10 nodes bends by 0.38 of its height: below a crease all over, beyond a wrinkle in its crests.
  const auto surface = [](int x, int) { return wave(x, 0.16F); };
  const Weighed with(surface);
  BendingExpectation none = kExpected;
  none.wrinkle = 0;
  const Weighed without(surface, none);
  for (int x = 4; x < kSize - 4; ++x)
    EXPECT_LT(with.system.bend_xx.row(kMiddle)[x], without.system.bend_xx.row(kMiddle)[x]);
  EXPECT_GT(with.least(4, kSize - 5), 100.0F / (1 + 1 + kMostWrinkled));
  for (const float value : without.wrinkled.values) EXPECT_EQ(value, 0.0F);
  // Ten times as high it cannot be held less for being relief, only for being creased.
  const Weighed wild([](int x, int) { return wave(x, 1.6F); });
  for (const float value : wild.wrinkled.values) EXPECT_LE(value, kMostWrinkled);
}

// A third of the height bends by a ninth of that: what noise does to plain skin.
TEST(BendingWeights, LittleWavesAllOverAreNoRelief) {
  const Weighed scene([](int x, int) { return wave(x, 0.05F); });
  for (const float value : scene.wrinkled.values) EXPECT_EQ(value, 0.0F);
}

TEST(BendingWeights, AFoldIsLetGoAcrossItsLineAndHeldAlongIt) {
  const Weighed folded([](int, int) { return 0.0F; }, kExpected, kMiddle);
  EXPECT_FLOAT_EQ(folded.system.bend_yy.row(kMiddle)[9], 100 / (1 + kFolded));
  EXPECT_FLOAT_EQ(folded.system.bend_xx.row(kMiddle)[9], 100);
  EXPECT_FLOAT_EQ(folded.system.bend_xy.row(kMiddle)[9], 200 / std::sqrt(1 + kFolded));
  EXPECT_FLOAT_EQ(folded.system.bend_yy.row(kMiddle + 1)[9], 100);
}

TEST(BendingWeights, OutsideTheDomainNothingIsHeld) {
  Weighed scene([](int x, int y) { return static_cast<float>((x * 7 + y * 3) % 5); });
  scene.domain.row(kMiddle)[kMiddle] = 0;
  weigh_bending(scene.d, scene.domain, kExpected, scene.folds, scene.fixture.pool, scene.across,
                scene.wrinkled, scene.system);
  EXPECT_EQ(scene.system.bend_xx.row(kMiddle)[kMiddle], 0);
  EXPECT_EQ(scene.system.bend_xx.row(kMiddle)[kMiddle - 1], 0);
  EXPECT_EQ(scene.system.bend_xx.row(kMiddle)[kMiddle + 1], 0);
  EXPECT_EQ(scene.system.bend_yy.row(kMiddle - 1)[kMiddle], 0);
  EXPECT_GT(scene.system.bend_xx.row(kMiddle - 1)[kMiddle], 0);
  for (int k = 0; k < kSize; ++k) {
    EXPECT_EQ(scene.system.bend_xx.row(0)[k], 0);
    EXPECT_EQ(scene.system.bend_yy.row(k)[kSize - 1], 0);
  }
}

}  // namespace
}  // namespace relievo::pipeline

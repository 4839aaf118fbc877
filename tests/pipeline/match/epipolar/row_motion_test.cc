// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/epipolar/row_aligner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

using test::StageFixture;

constexpr int kRowsWidth = 640;
constexpr int kRowsHeight = 640;

// Patches every 16 px over a face of 480 px, one in ten a liar; a hill of `height` at (320, 460).
struct Face {
  double height = 0;
  std::vector<LocalShift> locals;

  Face(double hill, double noise, std::uint32_t seed) : height(hill) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, 1);
    for (int y = 80; y <= 560; y += 16)
      for (int x = 80; x <= 560; x += 16) {
        const bool liar = random() % 10 == 0;
        const double sigma = liar ? 4 : noise;
        locals.push_back({x + 3.0, y - 2.0,
                          linear().at(x + 3.0, y - 2.0) + at(x + 3.0, y - 2.0) + sigma * normal(random), 500,
                          0});
      }
  }
  double at(double x, double y) const {
    return height * std::exp(-0.5 * ((x - 320) * (x - 320) + (y - 460) * (y - 460)) / (60.0 * 60));
  }
  static EpipolarShift linear() {
    EpipolarShift shift;
    shift.offset_px = 0.4, shift.slope_x = 1e-3;
    return shift;
  }
  RowMotion fit(StageFixture& fixture) const {
    RowMotion motion(&fixture.output, kRowsWidth, kRowsHeight);
    fit_row_motion(locals, linear(), 480, fixture.context, motion);
    return motion;
  }
};

TEST(RowMotion, NoiseIsNoMotion) {
  StageFixture fixture;
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    fixture.output.reset();
    const RowMotion motion = Face(0, 0.3, seed).fit(fixture);
    EXPECT_FALSE(motion.seen) << seed;
    EXPECT_EQ(motion.at(320, 460), 0);
    EXPECT_EQ(motion.rms_px, 0);
  }
}

TEST(RowMotion, AHillIsFoundAndTheRestStays) {
  StageFixture fixture;
  for (const double height : {-5.0, -1.5, 1.5, 5.0})
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
      fixture.output.reset();
      const Face face(height, 0.3, seed);
      const RowMotion motion = face.fit(fixture);
      ASSERT_TRUE(motion.seen) << height;
      double square = 0;
      double own = 0;
      for (const LocalShift& local : face.locals) {
        const double e = motion.at(local.x_px, local.y_px) - face.at(local.x_px, local.y_px);
        square += e * e;
        own += face.at(local.x_px, local.y_px) * face.at(local.x_px, local.y_px);
      }
      const auto n = static_cast<double>(face.locals.size());
      EXPECT_LT(std::sqrt(square / n), 0.08 + 0.02 * std::abs(height)) << height;
      EXPECT_NEAR(motion.at(320, 460), height, 0.2 + 0.06 * std::abs(height))
          << "the prior draws it down a little";
      EXPECT_NEAR(motion.at(320, 150), 0, 0.25);
      EXPECT_NEAR(motion.rms_px, std::sqrt(own / n), 0.1);
    }
}

TEST(RowMotion, TooLittleToTell) {
  StageFixture fixture;
  Face face(5, 0.3, 1);
  face.locals.resize(30);
  EXPECT_FALSE(face.fit(fixture).seen);
  face.locals.clear();
  EXPECT_FALSE(face.fit(fixture).seen);
}

TEST(RowMotion, NeedsNoMoreThanItsMemoryAndSaysWhenItIsShort) {
  StageFixture fixture(std::size_t{1} << 20, 4096);
  const Face face(5, 0.3, 1);
  RowMotion motion(&fixture.output, kRowsWidth, kRowsHeight);
  EXPECT_THROW(fit_row_motion(face.locals, Face::linear(), 480, fixture.context, motion), std::bad_alloc);
}

}  // namespace
}  // namespace relievo::pipeline

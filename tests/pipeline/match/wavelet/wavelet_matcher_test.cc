// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/wavelet/wavelet_matcher.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/pipeline/match/match_truth.h"

namespace relievo::pipeline {
namespace {

using test::BumpScene;
using test::MatchErrors;
using test::measure;
using test::StageFixture;

// The slow twin: every scale straight from its definition, by recursion.
struct WaveletTwin {
  const std::pmr::vector<float>& grey;
  int width, height;

  double smooth(int scale, int x, int y) const {
    x = std::clamp(x, 0, width - 1);
    y = std::clamp(y, 0, height - 1);
    if (scale == 0)
      return static_cast<double>(
          grey[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]);
    constexpr double kSpline[5] = {1, 4, 6, 4, 1};
    const int hole = 1 << (scale - 1);
    double sum = 0;
    for (int j = -2; j <= 2; ++j)
      for (int i = -2; i <= 2; ++i)
        sum += kSpline[i + 2] * kSpline[j + 2] / 256 * smooth(scale - 1, x + i * hole, y + j * hole);
    return sum;
  }
  double across(int scale, int x, int y) const {
    const int hole = 1 << (scale - 1);
    return 0.5 * (smooth(scale - 1, x + hole, y) - smooth(scale - 1, x - hole, y));
  }
  double down(int scale, int x, int y) const {
    const int hole = 1 << (scale - 1);
    return 0.5 * (smooth(scale - 1, x, y + hole) - smooth(scale - 1, x, y - hole));
  }
};

TEST(DyadicWavelet, IsItsDefinition) {
  StageFixture fixture(1 << 22, 1 << 22, 3);
  const RectifiedPair pair = BumpScene{.width_px = 48, .height_px = 40}.render(&fixture.output);
  const auto scales = transform_dyadic(pair.left.grey, 48, 40, 3, fixture.context);
  const WaveletTwin twin{pair.left.grey, 48, 40};
  ASSERT_EQ(scales.size(), 3U);
  for (int s = 1; s <= 3; ++s)
    for (const auto& [x, y] :
         {std::pair{24, 20}, std::pair{0, 0}, std::pair{47, 39}, std::pair{5, 30}, std::pair{40, 3}}) {
      EXPECT_NEAR(scales[static_cast<std::size_t>(s - 1)].row(y)[x].x, twin.across(s, x, y), 1e-3)
          << s << " " << x << " " << y;
      EXPECT_NEAR(scales[static_cast<std::size_t>(s - 1)].row(y)[x].y, twin.down(s, x, y), 1e-3);
    }
}

TEST(WaveletMatcher, FindsTheTrueSurface) {
  const MatchErrors lattice = measure(WaveletMatcher({}), {});
  EXPECT_LT(lattice.rms_px, 0.09);
  EXPECT_LT(lattice.wrong, 0.005);
  EXPECT_GT(lattice.covered, 0.99);
  const MatchErrors anywhere = measure(WaveletMatcher({}), {.scene = {}, .scattered = 800});
  EXPECT_LT(anywhere.rms_px, 0.09);
  EXPECT_LT(anywhere.wrong, 0.005);
}

TEST(WaveletMatcher, IsBlindToExposure) {
  const MatchErrors equal = measure(WaveletMatcher({}), {.scene = {.seed = 7}});
  const MatchErrors unequal =
      measure(WaveletMatcher({}), {.scene = {.right_gain = 0.7, .right_offset = 12, .seed = 7}});
  EXPECT_LT(unequal.rms_px, 1.1 * equal.rms_px + 0.005);
  EXPECT_GT(unequal.covered, 0.99);
  EXPECT_LT(unequal.mean_cost, equal.mean_cost + 0.02);
}

TEST(WaveletMatcher, FollowingSeveralCandidatesFindsMoreThanOne) {
  const BumpScene noisy{.width_px = 240, .height_px = 180, .contrast = 6, .noise = 3, .seed = 12};
  const MatchErrors one = measure(WaveletMatcher({.candidates = 1, .min_score = 0}), {.scene = noisy});
  const MatchErrors several = measure(WaveletMatcher({.candidates = 4, .min_score = 0}), {.scene = noisy});
  EXPECT_LT(several.wrong, one.wrong);
}

TEST(WaveletMatcher, SigmaSaysWhatTheErrorIs) {
  for (const BumpScene& scene :
       {BumpScene{.width_px = 220, .height_px = 160, .bump_px = 0, .contrast = 8, .noise = 1, .seed = 4},
        BumpScene{.width_px = 220,
        .height_px = 160,
        .bump_px = 4,
        .bump_radius_px = 90,
        .contrast = 20,
        .noise = 2,
        .seed = 6},
        BumpScene{.width_px = 220,
        .height_px = 160,
        .bump_px = 4,
        .bump_radius_px = 90,
        .contrast = 6,
        .noise = 1.5,
        .seed = 9}}) {
    const MatchErrors errors = measure(WaveletMatcher({}), {.scene = scene});
    EXPECT_GT(errors.within_sigma, 0.6);
    EXPECT_GT(errors.within_two_sigma, 0.9);
  }
}

}  // namespace
}  // namespace relievo::pipeline

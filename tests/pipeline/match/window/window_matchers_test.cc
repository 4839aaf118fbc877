// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pipeline/match/window/window_matchers.h"
#include "tests/pipeline/match/match_truth.h"

namespace relievo::pipeline {
namespace {

using test::BumpScene;
using test::MatchErrors;
using test::MatchTrial;
using test::measure;
using test::StageFixture;

// Most of it is the window's own: it flattens the bump by up to 0.08 px.
TEST(WindowMatchers, FindTheSurfaceToATenthOfAPixel) {
  const MatchErrors ssd = measure(SsdMatcher({.window_px = 15}), {});
  EXPECT_LT(ssd.rms_px, 0.09);
  EXPECT_LT(ssd.wrong, 0.001);
  EXPECT_GT(ssd.covered, 0.99);
  const MatchErrors zmncc = measure(ZmnccMatcher({.window_px = 15}), {});
  EXPECT_LT(zmncc.rms_px, 0.09);
  EXPECT_LT(measure(ZmnccMatcher({.window_px = 15}), {.scene = {.bump_px = 0}}).rms_px, 0.05);
  EXPECT_LT(zmncc.wrong, 0.001);
  EXPECT_GT(zmncc.covered, 0.99);
}

TEST(WindowMatchers, ScatteredKeypointsBetweenPixelsAreAsGood) {
  const MatchTrial anywhere{.scene = {}, .scattered = 1500};
  for (const MatchErrors& errors : {measure(SsdMatcher({.window_px = 15}), anywhere),
                                    measure(ZmnccMatcher({.window_px = 15}), anywhere)}) {
    EXPECT_LT(errors.rms_px, 0.10);
    EXPECT_LT(errors.wrong, 0.003);
    EXPECT_GT(errors.covered, 0.99);
  }
}

TEST(WindowMatchers, ThreeColoursSayMoreThanGrey) {
  const BumpScene faint{.contrast = 4, .noise = 1.5, .seed = 3};
  const MatchErrors grey = measure(ZmnccMatcher({.window_px = 9, .min_score = 0}), {.scene = faint});
  const MatchErrors colours = measure(ZmnccMatcher({.window_px = 9, .channels = 3, .min_score = 0}),
                                      {.scene = faint, .colours = true});
  EXPECT_LT(colours.wrong, 0.5 * grey.wrong);
  EXPECT_LT(colours.rms_px, 0.8 * grey.rms_px);
  const MatchErrors ssd =
      measure(SsdMatcher({.window_px = 9, .channels = 3}), {.scene = faint, .colours = true});
  EXPECT_LT(ssd.wrong, 0.5 * grey.wrong);
}

TEST(WindowMatchers, CorrelationIsBlindToExposureAndDifferencesAreNot) {
  const MatchTrial unequal{.scene = {.right_gain = 0.7, .right_offset = 12, .seed = 7}};
  const MatchErrors equal = measure(ZmnccMatcher({.window_px = 15}), {.scene = {.seed = 7}});
  const MatchErrors zmncc = measure(ZmnccMatcher({.window_px = 15}), unequal);
  EXPECT_LT(zmncc.rms_px, 1.1 * equal.rms_px + 0.005);
  EXPECT_GT(zmncc.covered, 0.99);
  EXPECT_LT(zmncc.mean_cost, equal.mean_cost + 0.02);
  const MatchErrors ssd =
      measure(SsdMatcher({.window_px = 15, .max_difference = 255, .sigma_limit_px = 10}), unequal);
  EXPECT_GT(ssd.mean_cost, 0.2);  // it says itself that the views are unlike
}

// On a slanted plane and on a face-like curve (radius 70 mm) from rich and quiet to faint and noisy.
TEST(WindowMatchers, SigmaSaysWhatTheErrorIs) {
  for (const BumpScene& scene :
       {BumpScene{.bump_px = 0, .contrast = 8, .noise = 1, .seed = 4},
        BumpScene{.bump_px = 0, .contrast = 20, .noise = 4, .seed = 5},
        BumpScene{.bump_px = 4, .bump_radius_px = 90, .contrast = 20, .noise = 2, .seed = 6},
        BumpScene{.bump_px = 4, .bump_radius_px = 90, .contrast = 5, .noise = 1.5, .seed = 9}}) {
    for (const MatchErrors& errors : {measure(SsdMatcher({.window_px = 15}), {.scene = scene}),
                                      measure(ZmnccMatcher({.window_px = 15}), {.scene = scene})}) {
      EXPECT_NEAR(errors.within_sigma, 0.68, 0.15);  // the face's bend is allowed for where there is none
      EXPECT_NEAR(errors.within_two_sigma, 0.95, 0.05);
    }
  }
}

// The slow twin: the published formula over every window and disparity, one after the other.
struct WindowTwin {
  const RectifiedPair& pair;
  int radius;
  bool correlate;

  double grey(const RectifiedView& view, int x, int y) const {
    return static_cast<double>(
        view.grey[static_cast<std::size_t>(y) * static_cast<std::size_t>(pair.width_px) +
                  static_cast<std::size_t>(x)]);
  }
  double unlike(int x, int y, int d) const {
    double n = 0, l = 0, r = 0, ll = 0, rr = 0, lr = 0, ssd = 0;
    for (int j = -radius; j <= radius; ++j)
      for (int i = -radius; i <= radius; ++i) {
        const double a = grey(pair.left, x + i, y + j);
        const double b = grey(pair.right, x - d + i, y + j);
        ++n;
        l += a;
        r += b;
        ll += a * a;
        rr += b * b;
        lr += a * b;
        ssd += (a - b) * (a - b);
      }
    return correlate ? 1 - (lr - l * r / n) / std::sqrt((ll - l * l / n) * (rr - r * r / n)) : ssd;
  }
  double disparity(int x, int y) const {
    const int first = static_cast<int>(std::floor(pair.disparity_px(pair.far_mm))) - 1;
    const int last = static_cast<int>(std::ceil(pair.disparity_px(pair.near_mm))) + 1;
    double least = std::numeric_limits<double>::infinity();
    int best = first;
    for (int d = first; d <= last; ++d) {
      if (x - d - radius < 0 || x - d + radius >= pair.width_px) continue;
      if (const double s = unlike(x, y, d); s < least) {
        least = s;
        best = d;
      }
    }
    if (best - 1 < first || best + 1 > last || x - best - 1 - radius < 0 ||
        x - best + 1 + radius >= pair.width_px)
      return -1e9;
    const double before = unlike(x, y, best - 1);
    const double after = unlike(x, y, best + 1);
    return best + (before - after) / (2 * (before - 2 * least + after));
  }
};

TEST(WindowMatchers, TheRunningSumsGiveWhatTheFormulasGive) {
  StageFixture fixture(std::size_t{16} << 20, std::size_t{32} << 20);
  const BumpScene scene{.width_px = 140,
                        .height_px = 70,
                        .base_px = 18,
                        .bump_px = 4,
                        .bump_radius_px = 25,
                        .noise = 2,
                        .seed = 8};
  const RectifiedPair pair = scene.render(&fixture.output);
  const Keypoints keypoints = test::lattice(pair, 3, &fixture.output);
  for (const bool correlate : {false, true}) {
    const auto fast = run_stage(fixture.context, [&](StageContext& c) {
      return correlate ? ZmnccMatcher({.window_px = 7, .min_score = 0, .sigma_limit_px = 10})
                             .match(pair, keypoints, c)
                       : SsdMatcher({.window_px = 7, .max_difference = 255, .sigma_limit_px = 10})
                             .match(pair, keypoints, c);
    });
    ASSERT_TRUE(fast);
    const WindowTwin twin{pair, 3, correlate};
    const auto visible = [&](Vec2f at) {
      return at.x > 12 && at.y > 4 && at.x < 128 && at.y < 65 && at.x - scene.disparity(at.x, at.y) > 12;
    };
    std::size_t expected = 0;
    for (const Keypoint& k : keypoints.points) expected += visible(k.at_px) ? 1 : 0;
    std::size_t matched = 0;
    for (const Match& m : fast->matches) {
      if (!visible(m.left_px)) continue;
      ++matched;
      EXPECT_NEAR(m.disparity_px,
                  twin.disparity(static_cast<int>(m.left_px.x), static_cast<int>(m.left_px.y)), 2e-4)
          << "correlate " << correlate << " at " << m.left_px.x << ", " << m.left_px.y;
    }
    EXPECT_EQ(matched, expected);
    EXPECT_GT(matched, 400U);
  }
}

TEST(WindowMatchers, NoWindowLooksAtPixelsThatAreNotThere) {
  StageFixture fixture(std::size_t{16} << 20, std::size_t{32} << 20);
  RectifiedPair pair = BumpScene{.width_px = 160, .height_px = 96}.render(&fixture.output);
  for (int y = 0; y < 96; ++y)
    for (int x = 60; x < 64; ++x)
      pair.right.valid[static_cast<std::size_t>(y) * 160 + static_cast<std::size_t>(x)] = 0;
  const Keypoints keypoints = test::lattice(pair, 2, &fixture.output);
  const auto matches = run_stage(fixture.context, [&](StageContext& c) {
    return ZmnccMatcher({.window_px = 9}).match(pair, keypoints, c);
  });
  ASSERT_TRUE(matches);
  for (const Match& m : matches->matches) {
    const float at = m.left_px.x - m.disparity_px;
    EXPECT_TRUE(at < 56 || at > 67) << at;
  }
  EXPECT_GT(matches->matches.size(), 500U);
}

TEST(WindowMatchers, EvenWindowsAndTwoChannelsAreRefused) {
  EXPECT_FALSE(check_options(SsdMatcher{.window_px = 10}, "ssd"));
  EXPECT_FALSE(check_options(ZmnccMatcher{.channels = 2}, "zmncc"));
}

}  // namespace
}  // namespace relievo::pipeline

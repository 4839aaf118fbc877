// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Does a selector choose the same places of the scene in both views (repeatability: Schmid, Mohr,
// Bauckhage 2000), more often than chance, and can what it chose be matched? Each view has noise of its own.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/pipeline/match/select/selection_fixture.h"

namespace relievo::pipeline {
namespace {

using test::BumpScene;
using test::StageFixture;

constexpr double kNearPx = 1.5;
const BumpScene kNoisyScene{.width_px = 400,
                            .height_px = 320,
                            .bump_radius_px = 80,
                            .noise = 2,
                            .right_gain = 0.8,
                            .right_offset = 10,
                            .seed = 21};

const RectifiedPair& rendered() {
  static const RectifiedPair pair = kNoisyScene.render(std::pmr::get_default_resource());
  return pair;
}

struct Figures {
  double count = 0;
  double repeated = 0;  // of the judged left points: one in the right view within kNearPx of the true partner
  double chance = 0;    // the same, if the right view's points were strewn at random
  double matched =
      0;  // of the judged left points: matched by `refined` within a quarter of a pixel of the truth
};

Figures figures_of(const std::string& name) {
  StageFixture fixture(std::size_t{32} << 20, std::size_t{96} << 20);
  const auto selector = test::make_selector(name, {{name + ".max_points", "1500"}});
  const auto& pair = rendered();
  RectifiedPair swapped(&fixture.output);
  swapped = pair;
  std::swap(swapped.left, swapped.right);
  const auto run = [&](auto&& stage) { return run_stage(fixture.context, stage); };
  const auto left = run([&](StageContext& c) { return selector(pair, c); });
  const auto right = run([&](StageContext& c) { return selector(swapped, c); });
  EXPECT_TRUE(left && right) << name;
  AlgorithmSet set;
  const auto made = make_algorithms(set);
  const auto matches = run([&](StageContext& c) { return made->matcher(pair, *left, c); });
  EXPECT_TRUE(matches) << name;
  Figures f;
  double judged = 0;
  for (const Keypoint& p : left->points) {
    ++f.count;
    const double x = static_cast<double>(p.at_px.x), y = static_cast<double>(p.at_px.y);
    if (!kNoisyScene.judged(x, y)) continue;
    ++judged;
    const double partner = x - kNoisyScene.disparity(x, y);
    f.repeated += std::any_of(right->points.begin(), right->points.end(), [&](const Keypoint& q) {
      return std::hypot(static_cast<double>(q.at_px.x) - partner, static_cast<double>(q.at_px.y) - y) <=
             kNearPx;
    });
  }
  for (const Match& m : matches->matches) {
    const double x = static_cast<double>(m.left_px.x), y = static_cast<double>(m.left_px.y);
    f.matched += kNoisyScene.judged(x, y) &&
                 std::abs(static_cast<double>(m.disparity_px) - kNoisyScene.disparity(x, y)) < 0.25;
  }
  f.repeated /= judged;
  f.matched /= judged;
  const double area = static_cast<double>(kNoisyScene.width_px) * kNoisyScene.height_px;
  f.chance =
      1 - std::exp(-static_cast<double>(right->points.size()) / area * std::numbers::pi * kNearPx * kNearPx);
  std::printf("| `%s` | %.0f | %.0f %% | %.0f %% | %.1f %% |\n", name.c_str(), f.count, 100 * f.repeated,
              100 * f.chance, 100 * f.matched);
  return f;
}

struct Promise {
  const char* name;
  double repeated;
};

class Repeatability : public testing::TestWithParam<Promise> {};

TEST_P(Repeatability, IsWhatTheSelectorPromises) {
  const Figures f = figures_of(GetParam().name);
  EXPECT_GT(f.repeated, GetParam().repeated);
  EXPECT_GT(f.matched, 0.99);
}

INSTANTIATE_TEST_SUITE_P(All, Repeatability,
                         testing::Values(Promise{"good-features", 0.7}, Promise{"harris", 0.75},
                                         Promise{"haar", 0.8}, Promise{"wavelet-salient", 0.3}),
                         [](const auto& promise) { return test::test_name(promise.param.name); });

// What looks at nothing repeats by chance: the measure itself is sound.
TEST(Repeatability, OfRandomPlacesIsChance) {
  const Figures f = figures_of("random");
  EXPECT_NEAR(f.repeated, f.chance, 0.03);
  EXPECT_GT(f.matched, 0.99);
}

}  // namespace
}  // namespace relievo::pipeline

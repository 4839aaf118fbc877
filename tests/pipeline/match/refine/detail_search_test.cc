// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Skin with pores at one depth, a highlight at another: the field that followed the highlight comes back.
#include "pipeline/match/refine/surface_refiner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pipeline/match/image/plane_filters.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

using test::StageFixture;

constexpr int kSkinWidth = 320;
constexpr int kSkinHeight = 200;
constexpr int kSkinLevel = 1;
constexpr float kSkin = 12;  // disparity in pixels of the level
constexpr float kHighlight = 9;
constexpr double kSpot = 22;  // sigma of the highlight

// Both views, noise and all.
struct SkinScene {
  StageFixture fixture{std::size_t{16} << 20, std::size_t{32} << 20};
  Plane<float> left{&fixture.output, kSkinWidth, kSkinHeight},
      right{&fixture.output, kSkinWidth, kSkinHeight};
  Plane<std::uint8_t> valid{&fixture.output, kSkinWidth, kSkinHeight, 1};
  SurfaceField field{&fixture.output, kSkinWidth, kSkinHeight, 1 << kSkinLevel};

  explicit SkinScene(float texture, float noise = 0.7F, unsigned seed = 3) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal(0, 1);
    Plane<float> skin(&fixture.output, kSkinWidth + 64, kSkinHeight),
        across(&fixture.output, kSkinWidth + 64, kSkinHeight);
    for (float& v : skin.values) v = normal(random);
    box_sum(skin, 1, fixture.context.pool, across, skin);  // pores of three pixels, as strong as a third
    const auto spot = [](double x, int y) {
      return 40 * std::exp(-((x - 160) * (x - 160) + (y - 100.0) * (y - 100.0)) / (2 * kSpot * kSpot));
    };
    for (int y = 0; y < kSkinHeight; ++y)
      for (int x = 0; x < kSkinWidth; ++x) {
        left.row(y)[x] =
            60 + texture / 3 * skin.row(y)[x] + static_cast<float>(spot(x, y)) + noise * normal(random);
        right.row(y)[x] =
            60 + texture / 3 * skin.row(y)[x + static_cast<int>(kSkin)] +
            static_cast<float>(spot(static_cast<double>(static_cast<float>(x) + kHighlight), y)) +
            noise * normal(random);
      }
    for (int y = 10; y < kSkinHeight - 10; ++y)
      for (int x = 40; x < kSkinWidth - 20; ++x) {
        field.domain.row(y)[x] = 1;
        const double at_highlight = std::hypot(x - 160, y - 100) < 1.5 * kSpot ? 1 : 0;
        field.disparity_px.row(y)[x] =
            (1 << kSkinLevel) * (kSkin + static_cast<float>(at_highlight) * (kHighlight - kSkin));
      }
  }
  RefinerScene views() const { return {left, right, valid, kSkinLevel, 1}; }
  // Root of the mean squared error in pixels of the level, within the highlight.
  double error() const {
    double sum = 0;
    int count = 0;
    for (int y = 0; y < kSkinHeight; ++y)
      for (int x = 0; x < kSkinWidth; ++x) {
        if (std::hypot(x - 160, y - 100) > kSpot) continue;
        const double e = static_cast<double>(field.disparity_px.row(y)[x] / (1 << kSkinLevel) - kSkin);
        sum += e * e;
        ++count;
      }
    return std::sqrt(sum / count);
  }
};

TEST(DetailSearch, ComesBackFromAHighlightToTheSkin) {
  SkinScene scene(2);
  ASSERT_GT(scene.error(), 2.9);
  EXPECT_TRUE(search_by_detail(scene.views(), scene.fixture.context, scene.field));
  EXPECT_LT(scene.error(), 0.3);
}

TEST(DetailSearch, LeavesWhatIsRight) {
  SkinScene scene(2);
  for (float& d : scene.field.disparity_px.values) d = kSkin * (1 << kSkinLevel);
  EXPECT_FALSE(search_by_detail(scene.views(), scene.fixture.context, scene.field));
  EXPECT_EQ(scene.error(), 0);
}

TEST(DetailSearch, FindsNothingInNoise) {
  SkinScene scene(0);
  const double before = scene.error();
  EXPECT_FALSE(search_by_detail(scene.views(), scene.fixture.context, scene.field));
  EXPECT_EQ(scene.error(), before);
}

TEST(DetailSearch, IsTheSameForAnyNumberOfThreads) {
  SkinScene one(2), two(2);
  ThreadPool alone(1), many(3);
  StageContext first{one.fixture.output, one.fixture.scratch, alone, one.fixture.progress,
                     one.fixture.cancelled};
  StageContext second{two.fixture.output, two.fixture.scratch, many, two.fixture.progress,
                      two.fixture.cancelled};
  EXPECT_TRUE(search_by_detail(one.views(), first, one.field));
  EXPECT_TRUE(search_by_detail(two.views(), second, two.field));
  EXPECT_EQ(one.field.disparity_px.values, two.field.disparity_px.values);
}

TEST(DetailSearch, WantsNodesOnThePixels) {
  SkinScene scene(2);
  SurfaceField other(&scene.fixture.output, kSkinWidth / 2, kSkinHeight / 2, 4);
  EXPECT_FALSE(search_by_detail(scene.views(), scene.fixture.context, other));
}

}  // namespace
}  // namespace relievo::pipeline

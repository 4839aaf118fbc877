// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Enlarged pictures against polynomials, which a cubic must repeat; and what enlarging is for: bars six
// pixels wide, which at half the size are taken for the wall.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pipeline/match/refine/refined_matcher.h"
#include "tests/support/bump_scene.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

constexpr int kEnlargedWidth = 320, kEnlargedHeight = 200;

RectifiedPair grey_pair(int width, int height) {
  RectifiedPair pair(std::pmr::get_default_resource());
  pair.width_px = width;
  pair.height_px = height;
  pair.focal_px = 1000;
  pair.baseline_mm = 100;
  pair.near_mm = 1000.0 * 100 / 60;
  pair.far_mm = 1000.0 * 100 / 4;
  pair.left_centre_px = pair.right_centre_px = {width / 2.0, height / 2.0};
  for (RectifiedView* view : {&pair.left, &pair.right}) {
    view->grey.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0F);
    view->valid.assign(view->grey.size(), 1);
  }
  return pair;
}

float& at(RectifiedView& view, int width, int x, int y) {
  return view
      .grey[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
}

TEST(EnlargedScene, RepeatsAPolynomialBetweenThePixels) {
  RectifiedPair pair = grey_pair(kEnlargedWidth, kEnlargedHeight);
  const auto grey = [](double x, double y) {
    return 100 + 0.2 * (x - 160) - 0.3 * (y - 100) + 0.001 * (x - 160) * (x - 160) +
           0.002 * (x - 160) * (y - 100);
  };
  for (int y = 0; y < kEnlargedHeight; ++y)
    for (int x = 0; x < kEnlargedWidth; ++x)
      at(pair.left, kEnlargedWidth, x, y) = static_cast<float>(grey(x, y));
  pair.left.valid[5 * kEnlargedWidth + 7] = 0;
  RectifiedPair made = enlarge(pair, std::pmr::get_default_resource());
  ASSERT_EQ(made.width_px, 2 * kEnlargedWidth);
  ASSERT_EQ(made.height_px, 2 * kEnlargedHeight);
  for (int y = 6; y < 2 * kEnlargedHeight - 6; ++y)
    for (int x = 6; x < 2 * kEnlargedWidth - 6; ++x)
      ASSERT_NEAR(at(made.left, 2 * kEnlargedWidth, x, y), grey((x - 0.5) / 2, (y - 0.5) / 2), 0.01)
          << x << " " << y;
  int invalid = 0;
  for (const std::uint8_t v : made.left.valid) invalid += v == 0 ? 1 : 0;
  EXPECT_EQ(invalid, 4);
  EXPECT_NEAR(made.depth_mm(2 * 17.3), pair.depth_mm(17.3), 1e-9) << "twice the disparity is the same depth";
}

TEST(EnlargedScene, WhatIsFoundComesBackInThePixelsAskedFor) {
  Keypoints keypoints(std::pmr::get_default_resource());
  keypoints.lattice_step_px = 2;
  keypoints.points = {{{10, 20}}, {{11.25F, 7.5F}}};
  const Keypoints large = enlarge(keypoints, std::pmr::get_default_resource());
  MatchSet set(std::pmr::get_default_resource());
  for (const Keypoint& k : large.points) set.matches.push_back({k.at_px, 12.5F, 0.1F, 0.2F});
  set.epipolar_shift.offset_px = 0.5;
  shrink(set, 2);
  EXPECT_EQ(set.lattice_step_px, 2);
  for (std::size_t i = 0; i < keypoints.points.size(); ++i) {
    EXPECT_EQ(set.matches[i].left_px.x, keypoints.points[i].at_px.x);
    EXPECT_EQ(set.matches[i].left_px.y, keypoints.points[i].at_px.y);
    EXPECT_EQ(set.matches[i].disparity_px, 6.25F);
  }
  EXPECT_EQ(set.epipolar_shift.offset_px, 0.25);
}

TEST(EnlargedScene, IsASmallOneInWhichNoFaceWasLookedFor) {
  EXPECT_TRUE(is_small_scene(grey_pair(741, 500)));
  EXPECT_FALSE(is_small_scene(grey_pair(1920, 1200)));
  RectifiedPair face = grey_pair(741, 500);
  face.region.assign(face.left.grey.size(), 1);
  EXPECT_FALSE(is_small_scene(face));
}

// Bars before a wall, six pixels wide, 40 apart.
bool on_bar(int x) { return x % 40 < 6; }

TEST(EnlargedScene, BarsSixPixelsWideStandBeforeTheirWall) {
  constexpr int kWall = 12, kBars = 20;
  RectifiedPair pair = grey_pair(kEnlargedWidth, kEnlargedHeight);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> grey(20, 230);
  for (int y = 0; y < kEnlargedHeight; ++y) {
    std::vector<float> wall(kEnlargedWidth + 64), bars(kEnlargedWidth + 64);
    for (float& v : wall) v = grey(random);
    for (float& v : bars) v = grey(random);
    for (int x = 0; x < kEnlargedWidth; ++x) {
      const auto k = static_cast<std::size_t>(x);
      at(pair.left, kEnlargedWidth, x, y) = on_bar(x) ? bars[k] : wall[k];
      at(pair.right, kEnlargedWidth, x, y) = on_bar(x + kBars) ? bars[k + kBars] : wall[k + kWall];
    }
  }
  test::StageFixture fixture(std::size_t{64} << 20, std::size_t{256} << 20);
  const Keypoints keypoints = test::lattice(pair, 1, &fixture.output);
  const auto found = run_stage(fixture.context,
                               [&](StageContext& c) { return RefinedMatcher({}).match(pair, keypoints, c); });
  ASSERT_TRUE(found);
  int right = 0, asked = 0, of_wall = 0, wrong_of_wall = 0;
  for (const Match& m : found->matches) {
    const bool bar = on_bar(static_cast<int>(m.left_px.x));
    right += bar && m.left_px.x > 60 && std::abs(m.disparity_px - kBars) < 1 ? 1 : 0;
    of_wall += !bar ? 1 : 0;
    wrong_of_wall += !bar && std::abs(m.disparity_px - kWall) > 1 ? 1 : 0;
  }
  for (const Keypoint& k : keypoints.points)
    asked += on_bar(static_cast<int>(k.at_px.x)) && k.at_px.x > 60 ? 1 : 0;
  EXPECT_GT(right, 0.7 * asked);
  EXPECT_GT(of_wall, 0.5 * kEnlargedWidth * kEnlargedHeight);
  EXPECT_LT(wrong_of_wall, 0.1 * of_wall) << "nor are bars wider than they are";
}

}  // namespace
}  // namespace relievo::pipeline

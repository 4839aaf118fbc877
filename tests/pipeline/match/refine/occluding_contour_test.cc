// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A near surface before a far one, the contour known, and a field that hangs from the one to the other.
#include "pipeline/match/refine/surface_refiner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pipeline/match/image/plane_filters.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

using test::StageFixture;

constexpr int kContourWidth = 240;
constexpr int kContourHeight = 160;
constexpr int kContourLevel = 1;
constexpr int kNearTop = 30,
              kNearBottom = 130;      // rows between which the near surface ends before the far one
constexpr int kNear = 24, kFar = 12;  // disparity in pixels of the level
constexpr int kHang = 6;              // nodes the curtain reaches to either side of the contour

// The near surface's last pixel and one: a contour that leans, as the ridge of a nose does.
int contour(int y) { return 100 + (y - kNearTop) / 4; }

struct ContourScene {
  StageFixture fixture{std::size_t{16} << 20, std::size_t{32} << 20};
  Plane<float> left{&fixture.output, kContourWidth, kContourHeight},
      right{&fixture.output, kContourWidth, kContourHeight};
  Plane<std::uint8_t> valid{&fixture.output, kContourWidth, kContourHeight, 1};
  SurfaceField field{&fixture.output, kContourWidth, kContourHeight, 1 << kContourLevel};

  // `brighter`: of the right view; `texture`, `noise`: standard deviations, grey levels.
  explicit ContourScene(float texture = 4, float brighter = 6, float noise = 0.7F) {
    std::mt19937 random(5);
    std::normal_distribution<float> normal(0, 1);
    Plane<float> near(&fixture.output, kContourWidth + 64, kContourHeight),
        far(&fixture.output, kContourWidth + 64, kContourHeight),
        across(&fixture.output, kContourWidth + 64, kContourHeight);
    for (Plane<float>* skin : {&near, &far}) {
      for (float& v : skin->values) v = normal(random);
      box_sum(*skin, 1, fixture.context.pool, across, *skin);
    }
    for (int y = 0; y < kContourHeight; ++y)
      for (int x = 0; x < kContourWidth; ++x) {
        const Plane<float>& seen = x < contour(y) ? near : far;
        left.row(y)[x] = 90 + texture / 3 * seen.row(y)[x] + noise * normal(random);
        const bool near_too = x + kNear < contour(y);
        const float there = near_too ? near.row(y)[x + kNear] : far.row(y)[x + kFar];
        right.row(y)[x] = 90 + brighter + texture / 3 * there + noise * normal(random);
      }
    for (int y = kNearTop; y < kNearBottom; ++y)
      for (int x = 50; x < kContourWidth - 20; ++x) {
        field.domain.row(y)[x] = 1;
        const float share =
            std::clamp((static_cast<float>(x - contour(y)) + kHang) / (2 * kHang), 0.0F, 1.0F);
        field.disparity_px.row(y)[x] = (1 << kContourLevel) * (kNear + share * (kFar - kNear));
      }
  }
  RefinerScene views() const { return {left, right, valid, kContourLevel, 1}; }
  int cut() { return cut_at_occluding_contours(views(), fixture.context, field); }
  float true_disparity(int x, int y) const {
    return static_cast<float>((1 << kContourLevel) * (x < contour(y) ? kNear : kFar));
  }
  // Nodes further than half a pixel of the level from the truth.
  int wrong() const {
    int count = 0;
    for (int y = kNearTop; y < kNearBottom; ++y)
      for (int x = 50; x < kContourWidth - 20; ++x)
        count += std::abs(field.disparity_px.row(y)[x] - true_disparity(x, y)) > 1 ? 1 : 0;
    return count;
  }
};

TEST(OccludingContour, ACurtainIsTakenDownAndTheContourFound) {
  ContourScene scene;
  const int rows = kNearBottom - kNearTop;
  ASSERT_GT(scene.wrong(), 10 * rows);
  EXPECT_EQ(scene.cut(), rows);
  EXPECT_LT(scene.wrong(), rows) << "a node a row";
}

TEST(OccludingContour, DullSkinUnderOtherLightToo) {
  ContourScene scene(2, -12);
  const int before = scene.wrong();
  EXPECT_GT(scene.cut(), (kNearBottom - kNearTop) / 2);
  EXPECT_LT(scene.wrong(), before / 3);
}

TEST(OccludingContour, SteepSkinStays) {
  ContourScene scene;
  // Skin that falls as steeply as the curtain, and both views say so: the right one shows it stretched.
  for (int y = 0; y < kContourHeight; ++y)
    for (int x = 0; x < kContourWidth; ++x) {
      const int at = x - static_cast<int>(scene.field.disparity_px.row(y)[x]) / (1 << kContourLevel);
      if (scene.field.domain.row(y)[x] != 0 && at >= 0) scene.right.row(y)[at] = scene.left.row(y)[x] + 6;
    }
  // Between the pixels that were written the stretched picture is what lies beside them.
  for (int y = kNearTop; y < kNearBottom; ++y)
    for (int x = 51; x < kContourWidth - 20; ++x) {
      const float from =
          static_cast<float>(x - 1) - scene.field.disparity_px.row(y)[x - 1] / (1 << kContourLevel);
      const float to = static_cast<float>(x) - scene.field.disparity_px.row(y)[x] / (1 << kContourLevel);
      for (int k = std::max(0, static_cast<int>(std::ceil(from))); k <= static_cast<int>(std::floor(to));
           ++k) {
        const float t = (static_cast<float>(k) - from) / (to - from);
        scene.right.row(y)[k] =
            6 + scene.left.row(y)[x - 1] + t * (scene.left.row(y)[x] - scene.left.row(y)[x - 1]);
      }
    }
  const auto before = scene.field.disparity_px.values;
  EXPECT_EQ(scene.cut(), 0);
  EXPECT_EQ(scene.field.disparity_px.values, before);
}

TEST(OccludingContour, NothingSteepNothingCut) {
  ContourScene scene;
  for (int y = 0; y < kContourHeight; ++y)
    for (int x = 0; x < kContourWidth; ++x)
      scene.field.disparity_px.row(y)[x] = static_cast<float>((1 << kContourLevel) * kNear);
  const auto before = scene.field.disparity_px.values;
  EXPECT_EQ(scene.cut(), 0);
  EXPECT_EQ(scene.field.disparity_px.values, before);
}

// Where the field ends beside a curtain nobody knows how the surface goes on.
TEST(OccludingContour, ACurtainAtTheFieldsEdgeIsLeftAlone) {
  ContourScene scene;
  for (int y = 0; y < kContourHeight; ++y)
    for (int x = contour(y) + kHang + 3; x < kContourWidth; ++x) scene.field.domain.row(y)[x] = 0;
  EXPECT_EQ(scene.cut(), 0);
}

// A chin before a throat: the contour lies across, and both views see all of both.
class LyingContour : public testing::TestWithParam<bool> {};

TEST_P(LyingContour, IsFoundWhicheverSideIsNear) {
  constexpr int kRow = 80;
  ContourScene scene(4, 6, 0.5F);
  std::mt19937 random(9);
  std::normal_distribution<float> normal(0, 1);
  Plane<float> skin(&scene.fixture.output, kContourWidth + 64, kContourHeight),
      across(&scene.fixture.output, kContourWidth + 64, kContourHeight);
  for (float& v : skin.values) v = normal(random);
  box_sum(skin, 1, scene.fixture.context.pool, across, skin);
  const auto level_px = [](int y) { return (y < kRow) == GetParam() ? kNear : kFar; };
  for (int y = 0; y < kContourHeight; ++y)
    for (int x = 0; x < kContourWidth; ++x) {
      scene.left.row(y)[x] = 90 + 4.0F / 3 * skin.row(y)[x] + 0.5F * normal(random);
      scene.right.row(y)[x] = 96 + 4.0F / 3 * skin.row(y)[x + level_px(y)] + 0.5F * normal(random);
      const float share = std::clamp((static_cast<float>(y - kRow) + kHang) / (2 * kHang), 0.0F, 1.0F);
      scene.field.disparity_px.row(y)[x] =
          (1 << kContourLevel) * (static_cast<float>(level_px(0)) +
                                  share * static_cast<float>(level_px(kContourHeight - 1) - level_px(0)));
    }
  const auto wrong = [&] {
    int count = 0;
    for (int y = kNearTop; y < kNearBottom; ++y)
      for (int x = 50; x < kContourWidth - 20; ++x)
        count += std::abs(scene.field.disparity_px.row(y)[x] -
                          static_cast<float>((1 << kContourLevel) * level_px(y))) > 1
                     ? 1
                     : 0;
    return count;
  };
  const int before = wrong(), columns = kContourWidth - 70;
  ASSERT_GT(before, 8 * columns);
  EXPECT_GE(scene.cut(), columns);
  EXPECT_LT(wrong(), columns) << "a node a column";
}
INSTANTIATE_TEST_SUITE_P(Both, LyingContour, testing::Bool());

TEST(OccludingContour, IsTheSameForAnyNumberOfThreads) {
  ContourScene one, two;
  ThreadPool alone(1), many(3);
  StageContext first{one.fixture.output, one.fixture.scratch, alone, one.fixture.progress,
                     one.fixture.cancelled};
  StageContext second{two.fixture.output, two.fixture.scratch, many, two.fixture.progress,
                      two.fixture.cancelled};
  EXPECT_EQ(cut_at_occluding_contours(one.views(), first, one.field),
            cut_at_occluding_contours(two.views(), second, two.field));
  EXPECT_EQ(one.field.disparity_px.values, two.field.disparity_px.values);
}

}  // namespace
}  // namespace relievo::pipeline

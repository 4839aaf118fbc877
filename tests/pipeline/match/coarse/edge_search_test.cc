// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A ridge that rises from a plane and falls off it steeply, as a nose does from its root to its tip, both
// known; and a field that lies over it like a blanket.
#include "pipeline/match/coarse/semi_global.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "pipeline/match/image/plane_filters.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

using test::StageFixture;

constexpr int kRidgeViewWidth = 640, kRidgeViewHeight = 400;
constexpr int kRidgeLeft = 260, kRidgeRight = 420;  // the ridge's columns in the left view
constexpr float kPlane = 48, kRise = 32;            // disparities, full-size pixels
constexpr int kBlanket = 24;                        // pixels beside the ridge's edge under the blanket
constexpr int kFrom = 90, kTo = 540, kFieldTop = 20, kFieldBottom = 380;  // the field

float ridge(int y) { return kPlane + kRise * std::clamp((static_cast<float>(y) - 120) / 120, 0.0F, 1.0F); }
float truth(int x, int y) { return x >= kRidgeLeft && x < kRidgeRight ? ridge(y) : kPlane; }

struct RidgeScene {
  StageFixture fixture{std::size_t{64} << 20, std::size_t{64} << 20};
  RectifiedPair pair{&fixture.output};
  SurfaceField field{&fixture.output, kRidgeViewWidth / 2, kRidgeViewHeight / 2, 2};

  RidgeScene() {
    const auto pixels = static_cast<std::size_t>(kRidgeViewWidth) * kRidgeViewHeight;
    pair.width_px = kRidgeViewWidth, pair.height_px = kRidgeViewHeight;
    pair.region.assign(pixels, 1);
    for (RectifiedView* view : {&pair.left, &pair.right})
      view->valid.assign(pixels, 1), view->grey.resize(pixels);
    std::mt19937 random(7);
    std::normal_distribution<float> normal(0, 1);
    Plane<float> near(&fixture.output, kRidgeViewWidth + 128, kRidgeViewHeight),
        far(&fixture.output, kRidgeViewWidth + 128, kRidgeViewHeight),
        across(&fixture.output, kRidgeViewWidth + 128, kRidgeViewHeight);
    for (Plane<float>* skin : {&near, &far}) {
      for (float& v : skin->values) v = normal(random);
      box_sum(*skin, 2, fixture.context.pool, across, *skin);
    }
    for (int y = 0; y < kRidgeViewHeight; ++y)
      for (int x = 0; x < kRidgeViewWidth; ++x) {
        const std::size_t k = static_cast<std::size_t>(y) * kRidgeViewWidth + static_cast<std::size_t>(x);
        pair.left.grey[k] =
            90 + 3 * (x >= kRidgeLeft && x < kRidgeRight ? near : far).row(y)[x] + 0.5F * normal(random);
        const float at = static_cast<float>(x) + ridge(y);
        const bool on_ridge = at >= kRidgeLeft && at < kRidgeRight;
        const int whole = static_cast<int>(at);
        const float part = at - static_cast<float>(whole);
        const float there = on_ridge
                                ? near.row(y)[whole] + part * (near.row(y)[whole + 1] - near.row(y)[whole])
                                : far.row(y)[x + static_cast<int>(kPlane)];
        pair.right.grey[k] = 90 + 3 * there + 0.5F * normal(random);
      }
  }
  // `blanket`: the field falls off the ridge over so many pixels to either side of its right edge.
  void lay(int blanket) {
    for (int j = 0; j < field.domain.height; ++j)
      for (int i = 0; i < field.domain.width; ++i) {
        const int x = 2 * i, y = 2 * j;
        if (x < kFrom || x >= kTo || y < kFieldTop || y >= kFieldBottom) continue;
        field.domain.row(j)[i] = 1;
        const float share = blanket == 0 ? 0.0F
                                         : std::clamp((static_cast<float>(x - kRidgeRight + blanket)) /
                                                          static_cast<float>(2 * blanket),
                                                      0.0F, 1.0F);
        const bool under = blanket > 0 && std::abs(x - kRidgeRight) < blanket;
        field.disparity_px.row(j)[i] = under ? ridge(y) + share * (kPlane - ridge(y)) : truth(x, y);
      }
  }
  void search(int threads = 2) {
    ThreadPool pool(threads);
    StageContext context{fixture.output, fixture.scratch, pool, fixture.progress, fixture.cancelled};
    const Pyramids pyramids = build_pyramids(pair, 3, context);
    ASSERT_TRUE(search_edges(pair, pyramids, {}, context, field).has_value());
  }
  // Nodes of the field at the steep part of the ridge's right edge that lie further than two pixels from the
  // truth.
  int wrong() const {
    int count = 0;
    for (int j = 260 / 2; j < 370 / 2; ++j)
      for (int i = (kRidgeRight - 2 * kBlanket) / 2; i < (kRidgeRight + 2 * kBlanket) / 2; ++i)
        count += std::abs(field.disparity_px.row(j)[i] - truth(2 * i, 2 * j)) > 2 ? 1 : 0;
    return count;
  }
};

TEST(EdgeSearch, TakesTheBlanketOffTheRidge) {
  RidgeScene scene;
  scene.lay(kBlanket);
  const int before = scene.wrong();
  ASSERT_GT(before, 1000);
  scene.search();
  EXPECT_LT(scene.wrong(), before / 4);
}

TEST(EdgeSearch, LeavesWhatIsRight) {
  RidgeScene scene;
  scene.lay(0);
  const auto before = scene.field.disparity_px.values;
  scene.search();
  int moved = 0, nodes = 0;
  for (int j = 260 / 2; j < 370 / 2; ++j)
    for (int i = kFrom / 2; i < kTo / 2; ++i) {
      const std::size_t k = static_cast<std::size_t>(j) * kRidgeViewWidth / 2 + static_cast<std::size_t>(i);
      moved += scene.field.disparity_px.values[k] != before[k] ? 1 : 0;
      ++nodes;
    }
  EXPECT_LT(moved, nodes / 20) << "but for what the ridge hides";
}

TEST(EdgeSearch, AddsWhatGoesOnBesideTheField) {
  RidgeScene scene;
  scene.lay(0);
  scene.search();
  int added = 0, right = 0;
  for (int j = kFieldTop / 2; j < kFieldBottom / 2; ++j)
    for (int i = kTo / 2; i < (kTo + 40) / 2; ++i) {
      if (scene.field.domain.row(j)[i] == 0) continue;
      ++added;
      right += std::abs(scene.field.disparity_px.row(j)[i] - kPlane) < 1 ? 1 : 0;
    }
  EXPECT_GT(added, (kFieldBottom - kFieldTop) / 2 * 10);
  EXPECT_GT(right, added * 95 / 100);
  EXPECT_EQ(scene.field.domain.row(100)[(kTo + 120) / 2], 0) << "not further than the box";
}

TEST(EdgeSearch, AnEmptyFieldStaysEmpty) {
  RidgeScene scene;
  scene.search();
  EXPECT_EQ(std::count(scene.field.domain.values.begin(), scene.field.domain.values.end(), std::uint8_t{1}),
            0);
}

TEST(EdgeSearch, IsTheSameForAnyNumberOfThreads) {
  RidgeScene one, three;
  one.lay(kBlanket), three.lay(kBlanket);
  one.search(1), three.search(3);
  EXPECT_EQ(one.field.disparity_px.values, three.field.disparity_px.values);
  EXPECT_EQ(one.field.domain.values, three.field.domain.values);
}

TEST(EdgeSearch, StopsWhenAsked) {
  RidgeScene scene;
  scene.lay(kBlanket);
  const Pyramids pyramids = build_pyramids(scene.pair, 3, scene.fixture.context);
  scene.fixture.cancelled = true;
  const auto stopped = search_edges(scene.pair, pyramids, {}, scene.fixture.context, scene.field);
  ASSERT_FALSE(stopped.has_value());
  EXPECT_EQ(stopped.error().code, Errc::Cancelled);
}

}  // namespace
}  // namespace relievo::pipeline

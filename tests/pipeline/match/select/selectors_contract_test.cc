// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every selector keeps, whichever it is.
#include <cmath>

#include "tests/pipeline/match/select/selection_fixture.h"

namespace relievo::pipeline {
namespace {

using test::SelectionFixture;

class SelectorContract : public testing::TestWithParam<std::string> {
 protected:
  KeypointSelector selector() const {
    return test::make_selector(GetParam(), {{"file-points.path", file_.path()}});
  }
  // As the table says, and as a mesher for lattices is told.
  static bool on_lattice() {
    AlgorithmSet set;
    EXPECT_TRUE(set.set("selector", GetParam()));
    return check_neighbours(set).has_value();
  }
  test::PointFile file_;
};

TEST_P(SelectorContract, StaysInsideTheRegionAndTheValidPicture) {
  SelectionFixture fixture;
  RectifiedPair pair(&fixture.output);
  pair = SelectionFixture::rendered();
  pair.region.assign(pair.left.grey.size(), 0);
  for (int y = 0; y < pair.height_px; ++y)
    for (int x = 0; x < pair.width_px; ++x) {
      const auto k = static_cast<std::size_t>(y * pair.width_px + x);
      if (std::hypot(x - 90, y - 70) < 60) pair.region[k] = 1;
      if (x + y < 130)
        pair.left.valid[k] = 0, pair.left.grey[k] = 0;  // an edge and corners, but no picture's
    }
  const auto chosen = fixture.select(selector(), pair);
  ASSERT_TRUE(chosen);
  ASSERT_GT(chosen->points.size(), 20U);
  double edge = 0;
  for (const Keypoint& p : chosen->points) {
    const auto k = static_cast<std::size_t>(std::lround(p.at_px.y) * pair.width_px + std::lround(p.at_px.x));
    EXPECT_TRUE(pair.region[k] != 0 && pair.left.valid[k] != 0) << p.at_px.x << " " << p.at_px.y;
    EXPECT_GT(p.strength, 0);
    edge += std::abs(p.at_px.x + p.at_px.y - 131) < 2 ? 1 : 0;
  }
  // The edge of the valid part has no more points than its share of the area, with room for chance.
  EXPECT_LT(edge, 8 + 0.04 * static_cast<double>(chosen->points.size()));
}

TEST_P(SelectorContract, PointsStandInRowsFromTheTopEachOnce) {
  SelectionFixture fixture;
  const auto chosen = fixture.select(selector(), SelectionFixture::rendered());
  ASSERT_TRUE(chosen);
  EXPECT_EQ(chosen->lattice_step_px > 0, on_lattice());
  EXPECT_EQ(chosen->points.get_allocator().resource(), &fixture.output);
  const auto& points = chosen->points;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const Vec2f a = points[k - 1].at_px, b = points[k].at_px;
    ASSERT_TRUE(a.y < b.y || (a.y == b.y && a.x < b.x)) << k;
  }
}

TEST_P(SelectorContract, NoMoreThanAskedFor) {
  SelectionFixture fixture;
  const std::string key = GetParam() + ".max_points";
  AlgorithmSet set;
  if (!set.set(key, "40")) return;  // it says where its points are, not how many
  const auto chosen =
      fixture.select(test::make_selector(GetParam(), {{key, "40"}}), SelectionFixture::rendered());
  ASSERT_TRUE(chosen);
  EXPECT_LE(chosen->points.size(), 40U);
  EXPECT_GE(chosen->points.size(), 20U);
  if (chosen->lattice_step_px > 0) return;
  // The strongest of all, not the first.
  EXPECT_GT(chosen->points.back().at_px.y, 100);
}

TEST_P(SelectorContract, AnEmptyRegionIsNoFace) {
  SelectionFixture fixture;
  RectifiedPair pair(&fixture.output);
  pair = SelectionFixture::rendered();
  pair.region.assign(pair.left.grey.size(), 0);
  const auto chosen = fixture.select(selector(), pair);
  ASSERT_FALSE(chosen);
  EXPECT_EQ(chosen.error().code, Errc::NoFace);
}

TEST_P(SelectorContract, APairWithoutPixelsIsRefused) {
  SelectionFixture fixture;
  const auto chosen = fixture.select(selector(), RectifiedPair(&fixture.output));
  ASSERT_FALSE(chosen);
  EXPECT_EQ(chosen.error().code, Errc::InvalidInput);
}

TEST_P(SelectorContract, APlainWallHasPointsOnlyWhereTheyDoNotDependOnIt) {
  SelectionFixture fixture;
  const auto chosen = fixture.select(selector(), fixture.plain());
  if (chosen) {
    EXPECT_TRUE(on_lattice() || GetParam() == "random" || GetParam() == "file-points");
    return;
  }
  EXPECT_EQ(chosen.error().code, Errc::TooFewMatches);
}

TEST_P(SelectorContract, TinyPicturesAreNoTrouble) {
  SelectionFixture fixture;
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(2, 9), std::pair(9, 2), std::pair(5, 5)}) {
    RectifiedPair pair(&fixture.output);
    pair.width_px = width;
    pair.height_px = height;
    for (RectifiedView* view : {&pair.left, &pair.right}) {
      view->grey.assign(static_cast<std::size_t>(width * height), 100);
      view->grey[0] = 200;
      view->valid.assign(static_cast<std::size_t>(width * height), 1);
    }
    const auto chosen = fixture.select(selector(), pair);
    EXPECT_TRUE(!chosen || !chosen->points.empty());
  }
}

TEST_P(SelectorContract, TooLittleMemoryIsAnError) {
  const RectifiedPair& pair = SelectionFixture::rendered();
  for (const std::size_t output : {std::size_t{16}, std::size_t{1} << 20}) {
    test::StageFixture fixture(output, output == 16 ? std::size_t{8} << 20 : 64);
    const auto chosen = run_stage(fixture.context, [&](StageContext& c) { return selector()(pair, c); });
    if (chosen && output > 16) continue;  // a lattice asks for no scratch memory
    ASSERT_FALSE(chosen);
    EXPECT_EQ(chosen.error().code, Errc::OutOfMemory);
  }
}

TEST_P(SelectorContract, StopsWhenAsked) {
  SelectionFixture fixture;
  fixture.cancelled = true;
  const auto chosen = selector()(SelectionFixture::rendered(), fixture.context);
  ASSERT_FALSE(chosen);
  EXPECT_EQ(chosen.error().code, Errc::Cancelled);
}

TEST_P(SelectorContract, GivesTheSameForAnyNumberOfThreads) {
  std::vector<float> first;
  for (const int threads : {1, 2, 3, 2}) {
    SelectionFixture fixture(threads);
    const auto chosen = fixture.select(selector(), SelectionFixture::rendered());
    ASSERT_TRUE(chosen);
    std::vector<float> all;
    for (const Keypoint& p : chosen->points) all.insert(all.end(), {p.at_px.x, p.at_px.y, p.strength});
    if (first.empty()) first = all;
    ASSERT_EQ(first, all) << threads << " threads";
  }
}

INSTANTIATE_TEST_SUITE_P(All, SelectorContract, testing::ValuesIn(test::names_of("selector")),
                         [](const auto& name) { return test::test_name(name.param); });

}  // namespace
}  // namespace relievo::pipeline

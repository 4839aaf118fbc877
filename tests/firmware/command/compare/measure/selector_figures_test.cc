// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/measure/comparison.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/bump_scene.h"
#include "tests/support/stage_fixture.h"

namespace relievo::firmware::compare {
namespace {

DisparityTruth truth_of(const test::BumpScene& scene) {
  DisparityTruth truth;
  truth.map = DisparityMap(scene.width_px, scene.height_px);
  for (int y = 0; y < scene.height_px; ++y)
    for (int x = 0; x < scene.width_px; ++x)
      if (scene.judged(x, y))
        truth.map.values[truth.map.index(x, y)] = static_cast<float>(scene.disparity(x, y));
  truth.seen = seen_by_both(truth.map);
  return truth;
}

TEST(SelectorFigures, RepeatabilityIsTheShareFoundAgainWhereItBelongs) {
  const test::BumpScene scene;
  const auto pair = scene.render(std::pmr::get_default_resource());
  pipeline::Keypoints left(std::pmr::get_default_resource());
  pipeline::Keypoints right(std::pmr::get_default_resource());
  pipeline::MatchSet matches(std::pmr::get_default_resource());
  std::size_t asked = 0;
  std::size_t again = 0;
  for (int y = 30; y < 220; y += 10)
    for (int x = 60; x < 290; x += 10) {
      left.points.push_back({{static_cast<float>(x), static_cast<float>(y)}, 1});
      const std::size_t kind = left.points.size() % 4;  // there exactly, nearly, too far away, not at all
      const auto d = static_cast<float>(scene.disparity(x, y));
      const float off = kind == 1 ? 1.2F : kind == 2 ? 1.8F : 0.0F;
      if (kind != 3) right.points.push_back({{static_cast<float>(x) - d + off, static_cast<float>(y)}, 1});
      if (kind != 2) matches.matches.push_back({.left_px = left.points.back().at_px, .disparity_px = d});
      if (!scene.judged(x, y)) continue;
      ++asked;
      again += kind < 2 ? 1U : 0U;
    }
  const DisparityTruth truth = truth_of(scene);
  const SelectorFigures f = selector_figures(pair, left, right, matches, truth);
  EXPECT_EQ(f.left, left.points.size());
  EXPECT_EQ(f.asked, asked);
  ASSERT_TRUE(f.repeatability.has_value());
  EXPECT_DOUBLE_EQ(*f.repeatability, static_cast<double>(again) / static_cast<double>(asked));
  EXPECT_NEAR(f.match_rate, 0.75, 0.01);
  // Without a truth the accepted matches say where to look: kind 2 is not asked, kind 3 is missed.
  const SelectorFigures blind = selector_figures(pair, left, right, matches, std::nullopt);
  EXPECT_EQ(blind.asked, matches.matches.size());
  EXPECT_NEAR(*blind.repeatability, 2.0 / 3, 0.01);
}

TEST(SelectorFigures, SpreadIsTheShareOfTheRegionsCells) {
  const test::BumpScene scene{.width_px = 320, .height_px = 256};
  auto pair = scene.render(std::pmr::get_default_resource());
  pipeline::Keypoints places(std::pmr::get_default_resource());
  for (int i = 0; i < 8; ++i)
    places.points.push_back({{static_cast<float>(20 * i + 5), 7}, 1});  // eight cells of the first row
  places.points.push_back({{6, 8}, 1});                                 // and one of them twice
  const pipeline::Keypoints none(std::pmr::get_default_resource());
  const pipeline::MatchSet matches(std::pmr::get_default_resource());
  const SelectorFigures whole = selector_figures(pair, places, none, matches, std::nullopt);
  EXPECT_DOUBLE_EQ(whole.spread, 8.0 / 256);
  EXPECT_FALSE(whole.repeatability.has_value()) << "nothing was asked";
  pair.region.assign(pair.left.valid.size(), 0);
  std::fill_n(pair.region.begin(), 320 * 16, std::uint8_t{1});  // the first row of cells
  EXPECT_DOUBLE_EQ(selector_figures(pair, places, none, matches, std::nullopt).spread, 8.0 / 16);
}

// Chooses every pixel of the region and remembers what it was shown.
struct Witness {
  Result<pipeline::Keypoints> operator()(const pipeline::RectifiedPair& pair,
                                         pipeline::StageContext& context) {
    shown = pair.left.grey[100 * static_cast<std::size_t>(pair.width_px) + 100];
    pipeline::Keypoints all(&context.output);
    for (int y = 0; y < pair.height_px; ++y)
      for (int x = 0; x < pair.width_px; ++x)
        if (pair.region[static_cast<std::size_t>(y) * static_cast<std::size_t>(pair.width_px) +
                        static_cast<std::size_t>(x)] != 0)
          all.points.push_back({{static_cast<float>(x), static_cast<float>(y)}, 1});
    return all;
  }
  float shown = 0;
};

TEST(SelectorFigures, TheRightViewIsShownWithItsOwnRegion) {
  const test::BumpScene scene;
  auto pair = scene.render(std::pmr::get_default_resource());
  pair.region.assign(pair.left.valid.size(), 1);
  DisparityMap map(scene.width_px, scene.height_px);
  map.values[map.index(150, 40)] = 25;
  test::StageFixture fixture(std::size_t{8} << 20, std::size_t{1} << 20, 1);
  Witness witness;
  const auto right = select_in_right(std::ref(witness), pair, map, fixture.context);
  ASSERT_TRUE(right);
  EXPECT_EQ(witness.shown, pair.right.grey[100 * static_cast<std::size_t>(pair.width_px) + 100]);
  ASSERT_EQ(right->points.size(), 3U) << "where the left's region went, a pixel around";
  EXPECT_EQ(right->points[1].at_px.x, 125);
  EXPECT_EQ(right->points[1].at_px.y, 40);
}

}  // namespace
}  // namespace relievo::firmware::compare

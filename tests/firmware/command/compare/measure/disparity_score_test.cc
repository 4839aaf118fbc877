// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Maps with errors that are known because they were put in.
#include "firmware/measure/comparison.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace relievo::firmware::compare {
namespace {

constexpr int kMapWidth = 100;
constexpr int kMapHeight = 40;

DisparityTruth flat(float disparity) {
  DisparityTruth truth;
  truth.map = DisparityMap(kMapWidth, kMapHeight);
  std::fill(truth.map.values.begin(), truth.map.values.end(), disparity);
  truth.seen = seen_by_both(truth.map);
  return truth;
}

TEST(DisparityScore, CountsHolesAsBadAndUnknownTruthNotAtAll) {
  DisparityTruth truth = flat(10);
  for (int x = 0; x < kMapWidth; ++x)
    truth.map.values[truth.map.index(x, 0)] = kNoDisparity;  // one row unknown
  DisparityMap map = truth.map;
  std::fill(map.values.begin(), map.values.end(), 10.25F);
  for (int x = 0; x < kMapWidth; ++x) {
    map.values[map.index(x, 1)] = kNoDisparity;  // a row of holes
    map.values[map.index(x, 2)] = 13;            // a row that is off by 3
    map.values[map.index(x, 3)] = 8.5F;          // and by -1.5
  }
  const DisparityScore s = score(map, truth, 1);
  EXPECT_EQ(s.judged, 3900U);
  EXPECT_EQ(s.given, 3800U);
  EXPECT_DOUBLE_EQ(s.bad_limit, 300.0 / 3900);
  EXPECT_DOUBLE_EQ(s.bad_1, s.bad_limit);
  EXPECT_DOUBLE_EQ(s.bad_2, 200.0 / 3900);
  EXPECT_DOUBLE_EQ(s.bad_4, 100.0 / 3900);
  EXPECT_DOUBLE_EQ(s.bad_half, 300.0 / 3900);
  EXPECT_DOUBLE_EQ(s.bad_given, 200.0 / 3800);
  EXPECT_DOUBLE_EQ(s.median_px, 0.25);
  EXPECT_NEAR(s.mean_px, (3600 * 0.25 + 100 * 3 + 100 * 1.5) / 3800, 1e-12);
  EXPECT_NEAR(s.rms_px, std::sqrt((3600 * 0.0625 + 100 * 9 + 100 * 2.25) / 3800), 1e-12);
  EXPECT_NEAR(s.bias_px, 0.25, 1e-12) << "of the good ones alone";
  std::size_t counted = 0;
  for (const std::size_t count : s.histogram.counts) counted += count;
  EXPECT_EQ(counted, s.given) << "every error is in a bin";
}

TEST(DisparityScore, ExactIsPerfectAndNothingIsAllBad) {
  const DisparityTruth truth = flat(7);
  const DisparityScore exact = score(truth.map, truth, 1);
  EXPECT_EQ(exact.bad_half, 0);
  EXPECT_EQ(exact.rms_px, 0);
  EXPECT_EQ(exact.density, 1);
  const DisparityScore nothing = score(DisparityMap(kMapWidth, kMapHeight), truth, 1);
  EXPECT_EQ(nothing.bad_limit, 1);
  EXPECT_EQ(nothing.density, 0);
  EXPECT_TRUE(std::isnan(nothing.median_px)) << "no figure of nothing";
}

TEST(DisparityScore, APixelBehindAnotherIsNotSeenByBoth) {
  // A block 20 px nearer than the ground hides 20 columns beside it from the right view; the ground's first
  // 10 columns leave its picture.
  DisparityTruth truth = flat(10);
  for (int y = 0; y < kMapHeight; ++y)
    for (int x = 60; x < 80; ++x) truth.map.values[truth.map.index(x, y)] = 30;
  truth.seen = seen_by_both(truth.map);
  for (int x = 0; x < kMapWidth; ++x) {
    const bool leaves = x < 10;
    const bool hidden = x >= 40 && x < 60;
    EXPECT_EQ(truth.seen[truth.map.index(x, 5)] == 0, leaves || hidden) << x;
  }
  const DisparityScore s = score(DisparityMap(kMapWidth, kMapHeight), truth, 1);
  EXPECT_EQ(s.seen, 70U * kMapHeight);
}

TEST(SharedScore, JudgesTwoMapsWhereBothGive) {
  const DisparityTruth truth = flat(10);
  DisparityMap bold = truth.map;     // gives everything, the lower half wrong
  DisparityMap careful = truth.map;  // right, and silent there but for one row
  for (int y = kMapHeight / 2; y < kMapHeight; ++y)
    for (int x = 0; x < kMapWidth; ++x) {
      bold.values[bold.index(x, y)] = 15;
      if (y > kMapHeight / 2) careful.values[careful.index(x, y)] = kNoDisparity;
    }
  const SharedScore s = score_shared(bold, careful, truth, 1);
  EXPECT_EQ(s.shared, 21U * kMapWidth);
  EXPECT_DOUBLE_EQ(s.bad_one, 1.0 / 21);
  EXPECT_EQ(s.bad_other, 0);
}

pipeline::MatchSet matches_on_lattice(int step, float disparity, int first_x = 0, int first_y = 0) {
  pipeline::MatchSet set(std::pmr::get_default_resource());
  set.lattice_step_px = step;
  for (int y = first_y; y < kMapHeight; y += step)
    for (int x = first_x; x < kMapWidth; x += step)
      set.matches.push_back({.left_px = {static_cast<float>(x), static_cast<float>(y)},
                             .disparity_px = disparity + 0.1F * static_cast<float>(x)});
  return set;
}

TEST(DisparityMapOfMatches, FillsBetweenTheNodesOfALatticeAndOnlyThere) {
  const DisparityMap slope = disparity_map(matches_on_lattice(4, 5), kMapWidth, kMapHeight);
  for (int x = 0; x < kMapWidth - 4; ++x) EXPECT_NEAR(slope.at(x, 9), 5 + 0.1 * x, 1e-4) << x;
  const DisparityMap part = disparity_map(matches_on_lattice(4, 5, 50, 11), kMapWidth, kMapHeight);
  for (int x = 0; x < 48; ++x) EXPECT_FALSE(part.known(x, 13)) << x;
  for (int x = 50; x < kMapWidth - 4; ++x) EXPECT_NEAR(part.at(x, 13), 5 + 0.1 * x, 1e-4) << x;
  pipeline::MatchSet scattered = matches_on_lattice(4, 5);
  scattered.lattice_step_px = 0;
  const DisparityMap points = disparity_map(scattered, kMapWidth, kMapHeight);
  EXPECT_EQ(std::count_if(points.values.begin(), points.values.end(), [](float d) { return !std::isnan(d); }),
            static_cast<std::ptrdiff_t>(scattered.matches.size()));
}

TEST(DisparityMapOfMatches, DoesNotBridgeAStepNorUseARejectedMatch) {
  pipeline::MatchSet set = matches_on_lattice(4, 5);
  for (pipeline::Match& match : set.matches) {
    match.disparity_px = match.left_px.x < 50 ? 5.0F : 25.0F;
    if (match.left_px.y >= 20) match.rejected_by = 2;
  }
  const DisparityMap map = disparity_map(set, kMapWidth, kMapHeight);
  for (int x = 0; x < kMapWidth; ++x) {
    EXPECT_TRUE(map.at(x, 8) == 5 || map.at(x, 8) == 25) << "no surface between, at " << x;
    EXPECT_FALSE(map.known(x, 30)) << x;
  }
}

TEST(RuleFigures, EveryMatchIsCountedWithTheFirstRuleThatRejectedIt) {
  const DisparityTruth truth = flat(10);
  pipeline::MatchSet set(std::pmr::get_default_resource());
  set.lattice_step_px = 1;
  const auto add = [&set](float x, float disparity, std::uint16_t rejected) {
    set.matches.push_back({.left_px = {x, 3}, .disparity_px = disparity, .rejected_by = rejected});
  };
  add(20, 10, 0);  // good, kept
  add(21, 14, 0);  // bad, kept
  add(22, 14, 1);  // bad, the first rule's
  add(23, 14, 6);  // bad, the second's (and the third's)
  add(24, 10, 4);  // good, the third's
  NamedSet chosen;
  ASSERT_TRUE(chosen.set.set("constraints", "similarity+uniqueness+continuity"));
  const MatchFigures f =
      figures_of(chosen, pipeline::Keypoints(std::pmr::get_default_resource()), set, truth, 1);
  EXPECT_EQ(f.matches, 5U);
  EXPECT_EQ(f.bad, 3U);
  EXPECT_EQ(f.accepted, 2U);
  EXPECT_EQ(f.accepted_bad, 1U);
  ASSERT_EQ(f.rules.size(), 3U);
  for (const RuleFigures& rule : f.rules) EXPECT_EQ(rule.rejected, 1U) << rule.name;
  EXPECT_EQ(f.rules[0].name, "similarity");
  EXPECT_EQ(f.rules[0].bad + f.rules[1].bad, 2U);
  EXPECT_EQ(f.rules[2].bad, 0U);
  const auto map = rejected_map(set, kMapWidth, kMapHeight);
  EXPECT_EQ(map[truth.map.index(23, 3)], 2);
  EXPECT_EQ(map[truth.map.index(20, 3)], 0);
}

}  // namespace
}  // namespace relievo::firmware::compare

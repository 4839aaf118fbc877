// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "pipeline/match/constraints/constraints.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

RectifiedPair picture(int width, int height) {
  RectifiedPair pair(std::pmr::get_default_resource());
  pair.width_px = width;
  pair.height_px = height;
  return pair;
}

std::vector<Match> wall(int columns, int rows, float disparity, float cost = 0.1F) {
  std::vector<Match> matches;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      matches.push_back(
          {{static_cast<float>(20 + 2 * x), static_cast<float>(2 * y)}, disparity, cost, 0.1F, 0});
  return matches;
}

TEST(SimilarityConstraint, TakesOnlyWhatIsUnlike) {
  test::StageFixture fixture(1024, 1 << 20, 1);
  auto matches = wall(5, 5, 3);
  matches[7].cost = 1.5F;
  matches[8].cost = std::numeric_limits<float>::quiet_NaN();
  SimilarityConstraint({.max_cost = 0.95F}).judge(picture(200, 40), matches, 2, 4, fixture.context);
  for (std::size_t k = 0; k < matches.size(); ++k)
    EXPECT_EQ(matches[k].rejected_by, k == 7 || k == 8 ? 4 : 0) << k;
}

TEST(UniquenessConstraint, TheNearerSurfaceHidesTheFarther) {
  test::StageFixture fixture(1024, 1 << 20, 1);
  std::vector<Match> matches{
      {{60, 4}, 20, 0, 0, 0}, {{50, 4}, 10, 0, 0, 0}, {{50, 6}, 10, 0, 0, 0}, {{41, 4}, 0.5F, 0, 0, 0}};
  UniquenessConstraint({.margin_px = 1.5F}).judge(picture(200, 40), matches, 2, 2, fixture.context);
  EXPECT_EQ(matches[0].rejected_by, 0);  // in front
  EXPECT_EQ(matches[1].rejected_by, 2);  // lands on the same right pixel, 10 px behind
  EXPECT_EQ(matches[2].rejected_by, 0);  // another row
  EXPECT_EQ(matches[3].rejected_by, 2);
}

TEST(UniquenessConstraint, ASlantedSurfaceIsNotItsOwnRival) {
  test::StageFixture fixture(1024, 1 << 20, 1);
  auto matches = wall(60, 4, 0);
  for (Match& m : matches) m.disparity_px = 10 + 0.4F * m.left_px.x;
  UniquenessConstraint({}).judge(picture(200, 40), matches, 2, 2, fixture.context);
  for (const Match& m : matches) EXPECT_EQ(m.rejected_by, 0);
}

TEST(ContinuityConstraint, TakesTheLonelyAndSparesTheSlope) {
  test::StageFixture fixture(1024, 1 << 20, 1);
  auto matches = wall(20, 10, 0);
  for (Match& m : matches) m.disparity_px = 0.5F * m.left_px.x;
  matches[5 * 20 + 9].disparity_px += 15;
  ContinuityConstraint({}).judge(picture(200, 40), matches, 2, 8, fixture.context);
  for (std::size_t k = 0; k < matches.size(); ++k) EXPECT_EQ(matches[k].rejected_by, k == 109 ? 8 : 0) << k;
}

TEST(Constraints, WhatOneRejectedTheNextDoesNotJudge) {
  test::StageFixture fixture(1024, 1 << 20, 1);
  auto matches = wall(5, 5, 3, 1.8F);
  for (Match& m : matches) m.rejected_by = 1;
  SimilarityConstraint({}).judge(picture(200, 40), matches, 2, 4, fixture.context);
  for (const Match& m : matches) EXPECT_EQ(m.rejected_by, 1);
}

}  // namespace
}  // namespace relievo::pipeline

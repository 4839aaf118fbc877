// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/watch/board_parameters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace relievo::tests {
namespace {

const pipeline::BoardPattern kSmallBoard{5, 3, 10};

// Upright, from (left, top), `step` px a square, sheared by `lean` columns a row.
pipeline::BoardCorners board(double left, double top, double step, double lean = 0) {
  pipeline::BoardCorners corners;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 5; ++column)
      corners.push_back({left + step * (column + lean * row), top + step * row});
  return corners;
}

pipeline::BoardParameters parameters(const pipeline::BoardCorners& corners) {
  return pipeline::parameters_of(corners, kSmallBoard, 1000, 500);
}

TEST(BoardParameters, AreThoseOfRos) {
  // 400 by 200 px: size is the root of 80000 / 500000, and places run from 141 to 859 across.
  const auto middle = parameters(board(299.5, 149.5, 100));
  EXPECT_NEAR(middle.size, 0.4, 1e-12);
  EXPECT_NEAR(middle.x, 0.5, 1e-3);
  EXPECT_NEAR(middle.y, 0.5, 3e-3);
  EXPECT_NEAR(middle.skew, 0, 1e-12);
  EXPECT_NEAR(middle.across, 0.5, 1e-12);
  EXPECT_NEAR(middle.tilt_across, 0, 1e-12);
  EXPECT_NEAR(middle.turn_rad, 0, 1e-12);
  const double border = std::sqrt(80000.0);
  EXPECT_NEAR(parameters(board(100, 100, 100)).x, (300 - border / 2) / (1000 - border), 1e-12);
  EXPECT_EQ(parameters(board(-200, 100, 100)).x, 0);
  // One column of shear a row is an angle of 45 degrees.
  EXPECT_NEAR(parameters(board(100, 100, 50, std::tan(0.1))).skew, 0.2, 1e-12);
  EXPECT_EQ(parameters(board(100, 100, 50, 1)).skew, 1);
}

TEST(BoardParameters, AreTheSameHoweverTheCornersAreCounted) {
  const auto corners = board(120, 90, 80, 0.1);
  const auto a = parameters(corners);
  const auto b = parameters({corners.rbegin(), corners.rend()});
  EXPECT_NEAR(distance_between(a, b), 0, 1e-12);
  EXPECT_NEAR(a.turn_rad, b.turn_rad, 1e-12);
}

TEST(BoardParameters, AnOutlineCornerThatIsNotSeenFollowsFromTheOthers) {
  auto corners = board(120, 90, 80, 0.1);
  const auto whole = parameters(corners);
  corners.front() = corners.back() = {std::nan(""), std::nan("")};
  const auto part = parameters(corners);
  EXPECT_NEAR(distance_between(whole, part), 0, 1e-5);
  EXPECT_NEAR(part.across, whole.across, 1e-5);
}

TEST(Coverage, BarsAreRangesAsRosDrawsThem) {
  pipeline::Coverage coverage;
  EXPECT_EQ(coverage.bars().least(), 0);
  const auto add = [&](const pipeline::BoardCorners& corners) {
    coverage.add(corners, parameters(corners), 1000, 500);
  };
  add(board(100, 100, 50));  // 200 by 100
  EXPECT_EQ(coverage.bars().x, 0);
  EXPECT_EQ(coverage.bars().y, 0);
  EXPECT_NEAR(coverage.bars().size, 0.5, 1e-12);
  EXPECT_EQ(coverage.bars().skew, 0);
  add(board(400, 200, 50));
  const double border = std::sqrt(20000.0);
  EXPECT_NEAR(coverage.bars().x, 300 / (1000 - border) / 0.7, 1e-12);
  EXPECT_NEAR(coverage.bars().y, 100 / (500 - border) / 0.7, 1e-12);
  const auto full = parameters(board(100, 100, 100, std::tan(0.3)));
  EXPECT_EQ(coverage.bars_with(full).size, 1);
  EXPECT_EQ(coverage.bars_with(full).skew, 1);
  EXPECT_NEAR(coverage.bars().size, 0.5, 1e-12) << "a question changes nothing";
  const auto less = pipeline::lesser({1, 0.2, 0.3, 0.9}, {0.1, 0.5, 0.4, 0.8});
  EXPECT_EQ(less.x, 0.1);
  EXPECT_EQ(less.y, 0.2);
  EXPECT_EQ(less.size, 0.3);
  EXPECT_EQ(less.skew, 0.8);
}

TEST(Coverage, TheMapCountsCorners) {
  pipeline::Coverage coverage;
  auto corners = board(0, 0, 10);  // all in the first cell of 125 by 62.5 px
  coverage.add(corners, parameters(corners), 1000, 500);
  EXPECT_EQ(coverage.map()[0], 15U);
  EXPECT_EQ(std::ranges::count(coverage.map(), 0U), 63);
  corners.front() = {std::nan(""), std::nan("")};
  corners.back() = {999, 499};
  coverage.add(corners, parameters(corners), 1000, 500);
  EXPECT_EQ(coverage.map()[0], 28U);
  EXPECT_EQ(coverage.map()[63], 1U);
}

}  // namespace
}  // namespace relievo::tests

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/board/board_finder.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/pipeline/calibrate/board/drawn_board.h"

namespace relievo::tests {
namespace {

// Root of the mean squared distance, for the better of the two ways round.
double error_px(const pipeline::BoardCorners& found, const DrawnBoard& board) {
  double best = 1e9;
  for (const bool turned : {false, true}) {
    double sum = 0;
    for (int i = 0; i < board.pattern.corners(); ++i) {
      const pipeline::Vec2d truth = board.at(i % board.pattern.columns, i / board.pattern.columns);
      const auto& at = found[static_cast<std::size_t>(turned ? board.pattern.corners() - 1 - i : i)];
      sum += (at.x - truth.x) * (at.x - truth.x) + (at.y - truth.y) * (at.y - truth.y);
    }
    best = std::min(best, std::sqrt(sum / board.pattern.corners()));
  }
  return best;
}

struct Condition {
  double noise, dark, bright, light_slope, limit_px;
};

class BoardFinder : public ::testing::TestWithParam<Condition> {};

TEST_P(BoardFinder, FindsTheCornersWhereTheyWereDrawn) {
  DrawnBoard board;
  const Condition& c = GetParam();
  board.noise = c.noise;
  board.dark = c.dark;
  board.bright = c.bright;
  board.light_slope = c.light_slope;
  const auto grey = board.draw();
  const auto found = pipeline::find_board(board.view(grey), board.pattern);
  ASSERT_TRUE(found) << found.error().what.view();
  ASSERT_EQ(found->size(), 54U);
  EXPECT_LT(error_px(*found, board), c.limit_px);
}

INSTANTIATE_TEST_SUITE_P(Light, BoardFinder,
                         ::testing::Values(Condition{0, 40, 200, 0, 0.05}, Condition{2, 40, 200, 0, 0.05},
                                           Condition{6, 60, 180, 0, 0.12}, Condition{3, 80, 130, 0, 0.15},
                                           Condition{2, 40, 220, 0.7, 0.1}));

TEST(BoardFinderFormats, ColourAndSixteenBitGiveTheSame) {
  const DrawnBoard board;
  const auto grey = board.draw();
  std::vector<std::byte> rgb;
  std::vector<std::byte> deep;
  for (const std::byte b : grey) {
    rgb.insert(rgb.end(), 3, b);
    deep.push_back(b);  // value * 257, either byte order
    deep.push_back(b);
  }
  const auto found = pipeline::find_board({rgb.data(), 640, 480, 3 * 640, PixelFormat::Rgb8}, board.pattern);
  ASSERT_TRUE(found);
  EXPECT_LT(error_px(*found, board), 0.05);
  const auto found_deep =
      pipeline::find_board({deep.data(), 640, 480, 2 * 640, PixelFormat::Grey16}, board.pattern);
  ASSERT_TRUE(found_deep);
  EXPECT_LT(error_px(*found_deep, board), 0.05);
}

TEST(BoardFinderFormats, WhatIsNoBoardIsNotFound) {
  const DrawnBoard board;
  EXPECT_EQ(pipeline::find_board({}, board.pattern).error().code, Errc::InvalidInput);
  const std::vector<std::byte> blank(640 * 480, std::byte{128});
  EXPECT_EQ(pipeline::find_board(board.view(blank), board.pattern).error().code, Errc::NotFound);
  const auto grey = board.draw();
  EXPECT_EQ(pipeline::find_board(board.view(grey), {8, 5, 20}).error().code, Errc::NotFound);
  EXPECT_EQ(pipeline::find_board(board.view(grey), {11, 6, 20}).error().code, Errc::NotFound);
  EXPECT_EQ(pipeline::find_board(board.view(grey), {0, 6, 20}).error().code, Errc::InvalidInput);
  EXPECT_EQ(pipeline::find_board({grey.data(), 4, 4, 640, PixelFormat::Grey8}, board.pattern).error().code,
            Errc::NotFound);
}

TEST(BoardFinderFormats, OrderIsMadeTheSameInBoth) {
  const DrawnBoard board;
  pipeline::BoardCorners left;
  for (int i = 0; i < 54; ++i) left.push_back(board.at(i % 9, i / 9));
  pipeline::BoardCorners right = left;
  std::reverse(right.begin(), right.end());
  pipeline::pair_order(left, right, board.pattern);
  EXPECT_EQ(right.front().x, left.front().x);
  pipeline::pair_order(left, right, board.pattern);
  EXPECT_EQ(right.front().x, left.front().x);
}

}  // namespace
}  // namespace relievo::tests

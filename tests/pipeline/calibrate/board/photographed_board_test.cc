// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The finder against the simulator's truth: what a calibration has to bear.
#include "tests/pipeline/calibrate/board/photographed_board.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace relievo::tests {
namespace {

using hal::sim::BoardKind;

struct Light {
  const char* name;
  double blur_px, noise;
  hal::sim::BoardLook look;
  double limit_px;  // rms
  int hidden;       // corners that may stay unseen
};

std::ostream& operator<<(std::ostream& out, const Light& light) { return out << light.name; }

const Light kLights[] = {
    {"good", 0.6, 1, {}, 0.02, 0},
    {"sharp", 0, 1, {}, 0.04, 0},
    {"blurred", 1.5, 1, {}, 0.03, 0},
    {"noisy", 0.6, 4, {}, 0.06, 0},
    {"blurred_and_noisy", 1.5, 4, {}, 0.1, 0},
    {"lamp_on_one_side", 0.6, 1, {0.8, 0, 0, 0}, 0.03, 0},
    {"lamp_blurred_noisy", 1.2, 3, {0.8, 0, 0, 0}, 0.12, 0},
    {"shadow", 0.6, 1, {0, 0.8, 0, 0}, 0.06, 10},
    {"highlight", 0.6, 1, {0, 0, 8, 0}, 0.05, 14},
};

class Photographed : public ::testing::TestWithParam<Light> {
 protected:
  PhotographedBoard board(BoardKind kind) const {
    PhotographedBoard board;
    board.print.kind = kind;
    board.look = GetParam().look;
    board.blur_px = GetParam().blur_px;
    board.noise = GetParam().noise;
    return board;
  }
  void judge(const PhotographedBoard& board) const {
    const hal::Picture picture = board.photograph();
    const auto found = pipeline::find_board(picture.view(), board.pattern());
    ASSERT_TRUE(found) << found.error().what.view();
    const CornerErrors errors = errors_of(*found, board);
    EXPECT_LT(errors.rms_px, GetParam().limit_px);
    EXPECT_LT(errors.worst_px, 6 * GetParam().limit_px);
    EXPECT_GE(errors.seen, board.pattern().corners() - GetParam().hidden);
  }
};

Errc error_of(const hal::Picture& picture, const pipeline::BoardPattern& pattern) {
  const auto found = pipeline::find_board(picture.view(), pattern);
  EXPECT_FALSE(found);
  return found ? Errc::InvalidState : found.error().code;
}

TEST_P(Photographed, Chessboard) { judge(board(BoardKind::Chessboard)); }
TEST_P(Photographed, Charuco) { judge(board(BoardKind::Charuco)); }

INSTANTIATE_TEST_SUITE_P(Light, Photographed, ::testing::ValuesIn(kLights),
                         [](const auto& light) { return light.param.name; });

TEST(PhotographedBoard, TiltedAndOfAnySize) {
  for (const auto kind : {BoardKind::Chessboard, BoardKind::Charuco})
    for (const auto& [across, down, square] :
         {std::tuple{5, 4, 40.0}, {20, 15, 8.0}, {3, 3, 40.0}, {9, 12, 13.0}}) {
      PhotographedBoard board;
      board.width_px = 960;
      board.print = {across, down, square, square, kind};
      board.tilt_deg = 52;
      board.compass_deg = 70;
      const hal::Picture picture = board.photograph();
      const auto found = pipeline::find_board(picture.view(), board.pattern());
      ASSERT_TRUE(found) << across << "x" << down << (kind == BoardKind::Charuco ? " ChArUco" : "");
      auto corners = *found;
      // A chessboard whose colours leave half a turn open may be found either way.
      if (corners.front().x > corners.back().x && kind == BoardKind::Chessboard)
        std::reverse(corners.begin(), corners.end());
      // A few crossings of the smallest squares, with markers beside them, are not trusted this far tilted.
      EXPECT_GE(errors_of(corners, board).seen, 95 * across * down / 100) << across << "x" << down;
      EXPECT_LT(errors_of(corners, board).rms_px, 0.1) << across << "x" << down;
    }
}

// The order is the board's own, whichever way up it is held.
TEST(PhotographedBoard, CharucoHasOneOrderOnly) {
  for (const double roll : {0.0, 90.0, 180.0, 265.0}) {
    PhotographedBoard board;
    board.print = {7, 7, 16, 12, BoardKind::Charuco};
    board.roll_deg = roll;
    const hal::Picture picture = board.photograph();
    const auto found = pipeline::find_board(picture.view(), board.pattern());
    ASSERT_TRUE(found) << roll;
    EXPECT_LT(errors_of(*found, board).rms_px, 0.05) << roll;
    pipeline::BoardCorners again = *found;
    const pipeline::BoardCorners reversed(found->rbegin(), found->rend());
    pipeline::pair_order(reversed, again, board.pattern());
    EXPECT_EQ(again.front().x, found->front().x) << "what the markers say stays";
  }
}

// Where only one turn has a black square in the first corner, a chessboard has one order, too.
TEST(PhotographedBoard, ColoursTellTheWayUp) {
  for (const double roll : {0.0, 180.0}) {
    PhotographedBoard board;
    board.roll_deg = roll;
    const hal::Picture picture = board.photograph();
    const auto found = pipeline::find_board(picture.view(), board.pattern());
    ASSERT_TRUE(found);
    EXPECT_LT(errors_of(*found, board).rms_px, 0.03) << roll;
  }
}

TEST(PhotographedBoard, OfACharucoBoardAPartWillDo) {
  PhotographedBoard covered;
  covered.print.kind = BoardKind::Charuco;
  covered.look.cover = 0.5;
  PhotographedBoard cut = covered;
  cut.look.cover = 0;
  cut.right_mm = 150;
  cut.down_mm = -50;
  for (const PhotographedBoard& board : {covered, cut}) {
    const hal::Picture picture = board.photograph();
    const auto found = pipeline::find_board(picture.view(), board.pattern());
    ASSERT_TRUE(found);
    const CornerErrors errors = errors_of(*found, board);
    EXPECT_LT(errors.rms_px, 0.04);
    EXPECT_LT(errors.worst_px, 0.3) << "a corner under the hand's edge is none";
    EXPECT_GE(errors.seen, 30);
    EXPECT_LT(errors.seen, 70);
    // A chessboard of which so much is missing is not found at all, and never with a wrong order.
    PhotographedBoard plain = board;
    plain.print.kind = BoardKind::Chessboard;
    EXPECT_EQ(error_of(plain.photograph(), plain.pattern()), Errc::NotFound);
  }
}

// A lens that is sharper than its pixels, and markers that leave a rim of three or four of them.
TEST(PhotographedBoard, SmallAndSharp) {
  for (const double blur_px : {0.0, 0.4})
    for (const double distance_mm : {560.0, 800.0}) {
      PhotographedBoard board;
      board.print.kind = BoardKind::Charuco;
      board.blur_px = blur_px;
      board.distance_mm = distance_mm;
      const hal::Picture picture = board.photograph();
      const auto found = pipeline::find_board(picture.view(), board.pattern());
      ASSERT_TRUE(found) << blur_px << ' ' << distance_mm;
      EXPECT_EQ(errors_of(*found, board).seen, 70) << blur_px << ' ' << distance_mm;
      EXPECT_LT(errors_of(*found, board).rms_px, 0.04) << blur_px << ' ' << distance_mm;
    }
}

TEST(PhotographedBoard, AnotherBoardIsNotThisOne) {
  PhotographedBoard board;
  board.print.kind = BoardKind::Charuco;
  const hal::Picture picture = board.photograph();
  pipeline::BoardPattern other = board.pattern();
  other.marker_bits = 5;
  EXPECT_EQ(error_of(picture, other), Errc::NotFound) << "another dictionary";
  board.print.kind = BoardKind::Chessboard;
  const hal::Picture plain = board.photograph();
  other.marker_bits = 4;
  EXPECT_EQ(error_of(plain, other), Errc::NotFound) << "no markers";
}

TEST(PhotographedBoard, FoundTwiceTheSame) {
  PhotographedBoard board;
  const hal::Picture picture = board.photograph();
  const auto once = pipeline::find_board(picture.view(), board.pattern());
  const auto twice = pipeline::find_board(picture.view(), board.pattern());
  ASSERT_TRUE(once && twice);
  for (std::size_t i = 0; i < once->size(); ++i) {
    EXPECT_EQ((*once)[i].x, (*twice)[i].x);
    EXPECT_EQ((*once)[i].y, (*twice)[i].y);
  }
}

}  // namespace
}  // namespace relievo::tests

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/watch/board_tracker.h"

#include <gtest/gtest.h>

#include "tests/pipeline/calibrate/live/held_board_pictures.h"

namespace relievo::tests {
namespace {

class Tracker : public ::testing::Test {
 protected:
  HeldBoardPictures board_{1280, 800};  // is looked for at half its size
  pipeline::BoardTracker tracker_{board_.pattern()};
};

TEST_F(Tracker, FollowsABoardAndRefinesIt) {
  double right_mm = 0;
  for (int i = 0; i < 3; ++i, right_mm += 15) {  // a long way from one picture to the next
    const BoardAt at{right_mm, 5, 600, 20, 10};
    const auto picture = board_.left(at);
    const auto seen = tracker_.look(picture.view());
    ASSERT_TRUE(seen);
    ASSERT_EQ(seen->corners.size(), 70U);
    EXPECT_LT(board_.rms_px(0, seen->corners, at), 0.3);
    EXPECT_NEAR(seen->edge_px, 2, 0.5);
    const auto fine = tracker_.refine(picture.view());
    ASSERT_TRUE(fine);
    ASSERT_EQ(fine->size(), 70U);
    EXPECT_LT(board_.rms_px(0, *fine, at), 0.05);
  }
}

TEST_F(Tracker, LosesWhatLeavesThePictureAndFindsItAgainElsewhere) {
  const auto whole = board_.left({-40, 0, 600});
  const auto cut_off = board_.left({-140, 0, 600});
  const auto elsewhere = board_.left({50, 10, 640});
  ASSERT_EQ(tracker_.look(whole.view())->corners.size(), 70U);
  EXPECT_TRUE(tracker_.look(cut_off.view())->corners.empty());
  EXPECT_TRUE(tracker_.refine(cut_off.view())->empty());
  EXPECT_EQ(tracker_.look(elsewhere.view())->corners.size(), 70U);
}

TEST_F(Tracker, ABoardThatJumpsIsFoundInTheWholePicture) {
  ASSERT_EQ(tracker_.look(board_.left({-70, -20, 640}).view())->corners.size(), 70U);
  EXPECT_EQ(tracker_.look(board_.left({70, 20, 640}).view())->corners.size(), 70U);
}

TEST_F(Tracker, MotionWhileTheShutterIsOpenWidensTheEdges) {
  const BoardAt at{0, 0, 560};
  BoardAt closed = at;
  closed.right_mm += 3;
  const auto sharp = tracker_.look(board_.left(at).view());
  const auto blurred = tracker_.look(board_.left(at, closed).view());
  ASSERT_FALSE(sharp->corners.empty());
  ASSERT_FALSE(blurred->corners.empty());
  EXPECT_LT(sharp->edge_px, 3);
  EXPECT_GT(blurred->edge_px, 6);  // 3 mm are 10 px here
}

TEST_F(Tracker, ColourAndSixteenBitShowTheSameBoard) {
  const BoardAt at{10, 5, 600, 15, -10};
  const auto grey = board_.left(at);
  const auto expected = tracker_.look(grey.view())->corners;
  ASSERT_EQ(expected.size(), 70U);
  for (const PixelFormat format : {PixelFormat::Rgb8, PixelFormat::Grey16}) {
    hal::Picture other{{}, grey.width_px, grey.height_px, format};
    for (const std::byte level : grey.bytes) {
      if (format == PixelFormat::Rgb8) other.bytes.insert(other.bytes.end(), 3, level);
      else {
        const int twelve_bit = std::to_integer<int>(level) * 16;
        other.bytes.push_back(static_cast<std::byte>(twelve_bit & 255));
        other.bytes.push_back(static_cast<std::byte>(twelve_bit >> 8));
      }
    }
    pipeline::BoardTracker fresh(board_.pattern());
    const auto seen = fresh.look(other.view());
    ASSERT_TRUE(seen);
    ASSERT_EQ(seen->corners.size(), 70U);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(seen->corners[i].x, expected[i].x, 0.1);
      EXPECT_NEAR(seen->corners[i].y, expected[i].y, 0.1);
    }
  }
}

TEST_F(Tracker, NoPictureIsAnError) { EXPECT_FALSE(tracker_.look({})); }

}  // namespace
}  // namespace relievo::tests

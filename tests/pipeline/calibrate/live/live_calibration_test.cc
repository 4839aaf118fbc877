// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/live_calibration.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/pipeline/calibrate/live/held_board_pictures.h"

namespace relievo::tests {
namespace {

using pipeline::LiveAdvice;
using pipeline::PairVerdict;

constexpr int kHeldWidth = 480;
constexpr int kHeldHeight = 300;

class Live : public ::testing::Test {
 protected:
  pipeline::LiveCalibration begin() { return *pipeline::LiveCalibration::begin(board_.pattern(), {}, pool_); }
  PairVerdict look(const hal::sim::PicturePair& pair) {
    now_ += std::chrono::milliseconds(100);
    EXPECT_TRUE(live_.look(pair.left.view(), pair.right.view(), now_));
    return live_.state().verdict;
  }
  PairVerdict look(const BoardAt& at) { return look(board_.pair(at)); }
  Errc error(const ImageView& left, const ImageView& right) {
    now_ += std::chrono::milliseconds(100);
    const auto looked = live_.look(left, right, now_);
    return looked ? Errc::InvalidState : looked.error().code;
  }

  HeldBoardPictures board_{kHeldWidth, kHeldHeight};
  ThreadPool pool_{2};
  pipeline::LiveCalibration live_ = begin();
  std::chrono::nanoseconds now_{0};
};

TEST_F(Live, AHeldBoardIsTakenWithItsPreciseCorners) {
  const BoardAt at{10, 5, 600, 10, -15};
  EXPECT_EQ(live_.state().advice, LiveAdvice::ShowBoard);
  EXPECT_EQ(live_.finish().error().code, Errc::InvalidState);
  EXPECT_EQ(look(at), PairVerdict::Moving);
  EXPECT_EQ(look(at), PairVerdict::Taken);
  for (const int eye : {0, 1}) {
    const auto& corners = live_.state().corners[static_cast<std::size_t>(eye)];
    ASSERT_EQ(corners.size(), 70U);
    EXPECT_LT(board_.rms_px(eye, corners, at), 0.1);
  }
  EXPECT_EQ(look(at), PairVerdict::AlreadyHave);
  EXPECT_EQ(live_.finish().error().code, Errc::PoorGeometry) << "one view is too few";
}

// A wave that comes back to where it was with every pair: at rest for the eye, not for the shutter.
TEST_F(Live, ABoardThatMovesWhileTheShutterIsOpenIsNotTaken) {
  const BoardAt opened{-2.4, 0, 560};
  const BoardAt closed{2.4, 0, 560};
  look(board_.pair(opened, closed));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(look(board_.pair(opened, closed)), PairVerdict::Blurred);
  EXPECT_EQ(live_.state().advice, LiveAdvice::TooBlurred);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(look({i % 2 == 0 ? 3.0 : -3.0, 0, 560}), PairVerdict::Moving);
  EXPECT_EQ(live_.state().views, 0);
}

TEST_F(Live, HalfABoardIsNotTaken) {
  // Beyond the point where the cameras look, each sees 30 mm that the other does not.
  int left_misses = 0;
  int right_misses = 0;
  for (double right_mm = -160; right_mm <= -135; right_mm += 5)
    for (int i = 0; i < 2; ++i) left_misses += look({right_mm, 0, 680}) == PairVerdict::LeftMissesIt ? 1 : 0;
  for (double right_mm = 140; right_mm >= 112; right_mm -= 5)
    for (int i = 0; i < 2; ++i)
      right_misses += look({right_mm, 0, 680}) == PairVerdict::RightMissesIt ? 1 : 0;
  EXPECT_GE(left_misses, 6);
  EXPECT_GE(right_misses, 6);
  EXPECT_EQ(look({0, -120, 560}), PairVerdict::NoBoard);
  EXPECT_EQ(live_.state().views, 0);
}

// Markers say which part of the board it is: it need not be whole.
TEST_F(Live, PartOfACharucoBoardIsTaken) {
  const pipeline::BoardPattern pattern{10, 7, 20, pipeline::BoardKind::Charuco};
  HeldBoardPictures board(960, 600, pattern);
  live_ = *pipeline::LiveCalibration::begin(pattern, {}, pool_);
  const BoardAt beyond_the_edge{110, 10, 560, 10, 20};
  look(board.pair(beyond_the_edge));
  EXPECT_EQ(look(board.pair(beyond_the_edge)), PairVerdict::Taken);
  const auto& corners = live_.state().corners[0];
  ASSERT_EQ(corners.size(), 70U);
  const auto seen =
      std::count_if(corners.begin(), corners.end(), [](const auto& at) { return pipeline::seen(at); });
  EXPECT_GT(seen, 20);
  EXPECT_LT(seen, 69);
  EXPECT_LT(board.seen_rms_px(0, corners, beyond_the_edge), 0.3);
  for (int i = 0; i < 2; ++i) look(board.pair({230, 10, 560}));
  EXPECT_EQ(live_.state().views, 1) << "a rim of it is too little";
}

TEST_F(Live, ABoardWithAnotherCountIsNone) {
  for (const auto& [columns, rows] : {std::pair(9, 6), std::pair(11, 8), std::pair(11, 7)}) {
    HeldBoardPictures other(kHeldWidth, kHeldHeight, {columns, rows, 18});
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(look(other.pair({0, 0, 620})), PairVerdict::NoBoard) << columns << 'x' << rows;
  }
  EXPECT_EQ(live_.state().advice, LiveAdvice::ShowBoard);
}

TEST_F(Live, PicturesOfOtherSizesAreErrors) {
  const BoardAt at;
  const auto pair = board_.pair(at);
  HeldBoardPictures larger(640, 400);
  const auto other = larger.pair(at);
  EXPECT_EQ(error(pair.left.view(), other.right.view()), Errc::InvalidInput);
  EXPECT_EQ(error({}, pair.right.view()), Errc::InvalidInput);
  EXPECT_EQ(live_.state().pairs, 0);
  look(pair);
  EXPECT_EQ(error(other.left.view(), other.right.view()), Errc::InvalidInput);
  EXPECT_EQ(live_.state().pairs, 1);
  EXPECT_EQ(look(at), PairVerdict::Taken) << "the right size goes on";
  live_.restart();
  EXPECT_EQ(live_.state().views, 0);
  now_ = {};
  EXPECT_EQ(look(other), PairVerdict::Moving) << "after a new beginning any size will do";
  const auto early = live_.look(other.left.view(), other.right.view(), now_);
  ASSERT_FALSE(early);
  EXPECT_EQ(early.error().code, Errc::InvalidInput) << "no time went by";
}

TEST_F(Live, ExchangedPicturesAreFoundOut) {
  const BoardAt opening[] = {{}, {0, 0, 560, 36}, {0, 0, 560, -36}, {0, 0, 560, 0, 36}, {0, 0, 560, 0, -36}};
  for (const BoardAt& at : opening)
    for (int i = 0; i < 2; ++i) {
      auto pair = board_.pair(at);
      std::swap(pair.left, pair.right);
      look(pair);
    }
  EXPECT_EQ(live_.state().views, 5);
  EXPECT_EQ(live_.state().advice, LiveAdvice::SwappedCameras);
}

TEST_F(Live, TheSamePairsGiveTheSameStatesWithAnyNumberOfThreads) {
  ThreadPool alone(1);
  auto other = *pipeline::LiveCalibration::begin(board_.pattern(), {}, alone);
  const BoardAt opening[] = {
      {}, {0, 0, 560, 36}, {0, 0, 560, -36}, {0, 0, 560, 0, 36}, {0, 0, 560, 0, -36}, {20, 10, 600, 20, 20}};
  for (const BoardAt& at : opening)
    for (int i = 0; i < 2; ++i) {
      const auto pair = board_.pair(at);
      look(pair);
      ASSERT_TRUE(other.look(pair.left.view(), pair.right.view(), now_));
      const auto& a = live_.state();
      const auto& b = other.state();
      EXPECT_EQ(a.verdict, b.verdict);
      EXPECT_EQ(a.advice, b.advice);
      EXPECT_EQ(a.error_mm, b.error_mm);
      EXPECT_EQ(a.how_far, b.how_far);
    }
  EXPECT_GE(live_.state().views, 5);
  EXPECT_GT(live_.state().error_mm, 0);
}

}  // namespace
}  // namespace relievo::tests

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/live_calibration.h"

#include <gtest/gtest.h>

#include "tests/pipeline/calibrate/live/held_board.h"

namespace relievo::tests {
namespace {

using pipeline::LiveAdvice;
using pipeline::LiveEnd;
using pipeline::PairVerdict;

class Collector : public ::testing::Test {
 protected:
  static pipeline::ViewCollector begin(const pipeline::LiveOptions& options = {}) {
    return *pipeline::ViewCollector::begin({7, 5, 28}, 1920, 1200, options);
  }
  // Shows the board and takes it where it is wanted.
  PairVerdict show(const pipeline::PairDetection& pair) {
    const auto wanted = collector_.consider(pair);
    EXPECT_TRUE(wanted);
    if (wanted && *wanted) {
      EXPECT_TRUE(collector_.take(pair.seen[0].corners, pair.seen[1].corners));
    }
    return collector_.state().verdict;
  }
  PairVerdict show(const BoardAt& at) { return show(board_.pair(at)); }
  // Comes to rest there: one pair to move, one to stand.
  PairVerdict hold(const BoardAt& at) {
    show(at);
    return show(at);
  }
  pipeline::PairDetection exchanged(const BoardAt& at) {
    auto pair = board_.pair(at);
    std::swap(pair.seen[0], pair.seen[1]);
    return pair;
  }
  void open(int views = 5) {
    const BoardAt opening[] = {{},
                               {0, 0, 560, 36},
                               {0, 0, 560, -36},
                               {0, 0, 560, 0, 36},
                               {0, 0, 560, 0, -36},
                               {20, 10, 600, 30, 30}};
    for (int i = 0; i < views; ++i) ASSERT_EQ(hold(opening[i]), PairVerdict::Taken) << i;
  }
  const pipeline::LiveState& state() const { return collector_.state(); }

  HeldBoardCorners board_{kiosk_rig(), {7, 5, 28}, 0.02, 1};
  pipeline::ViewCollector collector_ = begin();
};

TEST_F(Collector, TakesWhatIsStillSharpNewAndSeenByBoth) {
  EXPECT_EQ(state().advice, LiveAdvice::ShowBoard);
  EXPECT_EQ(show(BoardAt{}), PairVerdict::Moving) << "nothing is known yet about its motion";
  EXPECT_EQ(state().advice, LiveAdvice::HoldStill);
  EXPECT_EQ(show(BoardAt{}), PairVerdict::Taken);
  EXPECT_EQ(state().views, 1);
  EXPECT_EQ(state().corners[0].size(), 35U);
  EXPECT_EQ(state().corners[1].size(), 35U);
}

TEST_F(Collector, ABoardThatShakesIsNotTaken) {
  for (int i = 0; i < 40; ++i) {
    BoardAt at;
    at.right_mm = i % 2 == 0 ? 0.3 : -0.3;  // 3 px to and fro
    EXPECT_EQ(show(at), PairVerdict::Moving);
    EXPECT_EQ(state().advice, LiveAdvice::HoldStill);
  }
  EXPECT_EQ(state().views, 0);
  EXPECT_GT(state().moved_px[0], 2);
}

TEST_F(Collector, ABoardThatOnlyTurnsAboutItsMiddleMovesToo) {
  for (int i = 0; i < 10; ++i) {
    BoardAt at;
    at.roll_deg = i % 2 == 0 ? 0.4 : -0.4;
    EXPECT_EQ(show(at), PairVerdict::Moving);
  }
}

TEST_F(Collector, ABlurredBoardIsNotTakenThoughItIsStill) {
  for (const int blurred : {0, 1})
    for (int i = 0; i < 3; ++i) {
      auto pair = board_.pair({});
      pair.seen[static_cast<std::size_t>(blurred)].edge_px = 6;
      EXPECT_EQ(show(pair), i == 0 && blurred == 0 ? PairVerdict::Moving : PairVerdict::Blurred);
    }
  EXPECT_EQ(state().advice, LiveAdvice::TooBlurred);
  EXPECT_EQ(state().views, 0);
}

TEST_F(Collector, TheSameViewIsTakenOnce) {
  ASSERT_EQ(hold({}), PairVerdict::Taken);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(show(BoardAt{}), PairVerdict::AlreadyHave);
  BoardAt nearly;
  nearly.right_mm = 8;
  nearly.yaw_deg = 4;
  EXPECT_EQ(hold(nearly), PairVerdict::AlreadyHave);
  EXPECT_EQ(state().views, 1);
}

TEST_F(Collector, ABoardThatOneCameraMissesIsNotTaken) {
  const BoardAt left_of_all{-125, 0, 560};  // the pictures end at 182 mm
  const BoardAt right_of_all{125, 0, 560};
  auto pair = board_.pair({});
  pair.seen[0] = {};
  EXPECT_EQ(show(pair), PairVerdict::LeftMissesIt);
  EXPECT_EQ(state().advice, LiveAdvice::LeftCameraMissesIt);
  pair = board_.pair({});
  pair.seen[1] = {};
  EXPECT_EQ(show(pair), PairVerdict::RightMissesIt);
  EXPECT_EQ(state().advice, LiveAdvice::RightCameraMissesIt);
  EXPECT_EQ(show(left_of_all), PairVerdict::NoBoard);
  EXPECT_EQ(show(right_of_all), PairVerdict::NoBoard);
  EXPECT_EQ(state().advice, LiveAdvice::ShowBoard);
  EXPECT_EQ(state().views, 0);
}

TEST_F(Collector, TheFirstReasonIsNamed) {
  ASSERT_EQ(hold({}), PairVerdict::Taken);
  BoardAt moved;
  moved.right_mm = 0.5;
  auto pair = board_.pair(moved);  // moving, blurred and known
  pair.seen[0].edge_px = 9;
  EXPECT_EQ(show(pair), PairVerdict::Moving);
  pair = board_.pair(moved);  // blurred and known
  pair.seen[0].edge_px = 9;
  EXPECT_EQ(show(pair), PairVerdict::Blurred);
  EXPECT_EQ(show(moved), PairVerdict::AlreadyHave);
}

TEST_F(Collector, WhatCannotBeIsAnErrorAndChangesNothing) {
  ASSERT_EQ(hold({}), PairVerdict::Taken);
  const int pairs = state().pairs;
  auto other = board_.pair({});
  other.seen[1].corners.resize(54);
  auto wanted = collector_.consider(other);
  ASSERT_FALSE(wanted);
  EXPECT_EQ(wanted.error().code, Errc::InvalidInput);
  auto late = board_.pair({});
  late.at = std::chrono::milliseconds(1);
  wanted = collector_.consider(late);
  ASSERT_FALSE(wanted);
  EXPECT_EQ(wanted.error().code, Errc::InvalidInput);
  EXPECT_EQ(state().pairs, pairs);
  EXPECT_EQ(state().views, 1);
  pipeline::LiveOptions options;
  options.max_views = 4;
  EXPECT_FALSE(pipeline::ViewCollector::begin({7, 5, 28}, 1920, 1200, options));
  options = {};
  options.goal_mm = 0;
  EXPECT_FALSE(pipeline::ViewCollector::begin({7, 5, 28}, 1920, 1200, options));
  EXPECT_FALSE(pipeline::ViewCollector::begin({7, 5, 28}, 0, 1200, {}));
}

TEST_F(Collector, ExchangedCamerasAreFoundOutWithTheFirstCalibration) {
  const BoardAt opening[] = {{}, {0, 0, 560, 36}, {0, 0, 560, -36}, {0, 0, 560, 0, 36}, {0, 0, 560, 0, -36}};
  for (const BoardAt& at : opening) {
    show(exchanged(at));
    show(exchanged(at));
  }
  EXPECT_EQ(state().advice, LiveAdvice::SwappedCameras);
  show(exchanged({20, 10, 600, 30, 30}));
  EXPECT_EQ(show(exchanged({20, 10, 600, 30, 30})), PairVerdict::Swapped);
  EXPECT_EQ(state().views, 5);
  EXPECT_FALSE(collector_.finish());
}

TEST_F(Collector, CamerasExchangedMidwayAreFoundOutAtOnce) {
  open();
  const BoardAt next{20, 10, 600, 30, 30};
  show(exchanged(next));
  EXPECT_EQ(show(exchanged(next)), PairVerdict::Swapped);
  EXPECT_EQ(state().advice, LiveAdvice::SwappedCameras);
  EXPECT_EQ(hold(next), PairVerdict::Taken) << "and exchanged back again";
  EXPECT_EQ(state().views, 6);
}

TEST_F(Collector, FiveViewsGiveACalibrationAndAnHonestError) {
  open(4);
  EXPECT_FALSE(collector_.newest());
  EXPECT_EQ(state().error_mm, 0);
  collector_ = begin();
  open(5);
  ASSERT_TRUE(collector_.newest());
  EXPECT_GT(state().error_mm, 0);
  EXPECT_LT(board_.true_error_mm(collector_.newest()->calibration, 560), 3 * state().error_mm);
  EXPECT_TRUE(state().wanted);
  const auto finished = collector_.finish();
  ASSERT_TRUE(finished);
  EXPECT_EQ(finished->calibration.left.focal_px.x, collector_.newest()->calibration.left.focal_px.x);
}

// A board whose squares are not as large as was said: that ends it as soon as it is known, and the end says
// why.
TEST_F(Collector, AWrongSquareSizeIsNoticedByTheBaseline) {
  pipeline::LiveOptions options;
  options.full_bar = 0;
  options.goal_mm = 10;
  options.min_views = options.max_views = 6;
  options.expected_baseline_mm = 140;
  collector_ = begin(options);
  open(6);
  EXPECT_EQ(state().end, LiveEnd::GoalReached);
  options.expected_baseline_mm = 150;
  collector_ = begin(options);
  open(5);
  EXPECT_EQ(state().end, LiveEnd::Plateau);
  const auto finished = collector_.finish();
  ASSERT_TRUE(finished);
  EXPECT_EQ(finished->quality.verdict, pipeline::CalibrationVerdict::Refuse);
}

TEST_F(Collector, EndsWhenNothingMoreIsAllowed) {
  pipeline::LiveOptions options;
  options.goal_mm = 0.001;
  options.plateau_gain = 0;
  options.min_views = options.max_views = 6;
  collector_ = begin(options);
  open(6);
  EXPECT_EQ(state().end, LiveEnd::Full);
  EXPECT_EQ(state().advice, LiveAdvice::Done);
  EXPECT_EQ(hold({-20, 10, 640, -30, 30}), PairVerdict::Finished);
  EXPECT_EQ(state().views, 6);
  EXPECT_EQ(collector_.views().views.size(), 6U);
  EXPECT_TRUE(collector_.finish());
}

TEST_F(Collector, EndsWhenMoreViewsWouldNotHelp) {
  pipeline::LiveOptions options;
  options.goal_mm = 0.001;
  options.full_bar = 0;
  options.plateau_gain = 0.5;  // halving the error takes more than one view
  options.min_views = 6;
  collector_ = begin(options);
  open(6);
  EXPECT_EQ(state().end, LiveEnd::Plateau);
}

TEST_F(Collector, EndsAtTheGoalOnlyWithFullBarsAndEnoughViews) {
  pipeline::LiveOptions options;
  options.goal_mm = 10;
  options.full_bar = 0;
  collector_ = begin(options);
  open(6);
  EXPECT_EQ(state().end, LiveEnd::NotYet) << "six views are few";
  options.min_views = 6;
  options.full_bar = 0.9;
  collector_ = begin(options);
  open(6);
  EXPECT_EQ(state().end, LiveEnd::NotYet) << "all in the middle";
  options.full_bar = 0;
  collector_ = begin(options);
  open(6);
  EXPECT_EQ(state().end, LiveEnd::GoalReached);
}

TEST_F(Collector, APassedViewIsNotTaken) {
  show(BoardAt{});
  ASSERT_TRUE(*collector_.consider(board_.pair({})));
  collector_.pass(true, false);
  EXPECT_EQ(state().verdict, PairVerdict::RightMissesIt);
  EXPECT_EQ(state().views, 0);
  EXPECT_EQ(show(BoardAt{}), PairVerdict::Taken);
}

}  // namespace
}  // namespace relievo::tests

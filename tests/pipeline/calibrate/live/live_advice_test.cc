// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is said leads where it should.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "pipeline/calibrate/live/live_calibration.h"
#include "tests/pipeline/calibrate/live/held_board.h"

namespace relievo::tests {
namespace {

using pipeline::LiveAdvice;

pipeline::BoardCorners corners_at(int eye, const BoardAt& at) {
  HeldBoardCorners board(kiosk_rig(), kHeldPattern, 0, 1);
  auto seen = board.seen(eye, at);
  if (seen.corners.empty()) throw std::logic_error("the test holds the board out of the picture");
  return seen.corners;
}

pipeline::BoardParameters seen_at(const BoardAt& at) {
  return pipeline::parameters_of(corners_at(0, at), kHeldPattern, 1920, 1200);
}

pipeline::Room room_at(const BoardAt& at) {
  pipeline::Room room{1920, 1200, {}};
  for (int eye = 0; eye < 2; ++eye)
    room.board[static_cast<std::size_t>(eye)] =
        with_border(outline_of(corners_at(eye, at), kHeldPattern), kHeldPattern);
  return room;
}

pipeline::ViewTarget target_at(const BoardAt& at) {
  pipeline::ViewTarget target;
  target.at = pipeline::axes_of(seen_at(at));
  target.tolerance = {0.02, 0.02, 0.05, 0.08, 0.08, 0.08};
  return target;
}

// The first word on the way from one pose to the other.
LiveAdvice word(const BoardAt& from, const BoardAt& to) {
  pipeline::Guide guide;
  const auto way = guide.towards(target_at(to), seen_at(from), room_at(from));
  return way ? way->word : LiveAdvice::HoldStill;
}

TEST(LiveAdvice, NamesTheWayAsTheLeftPictureShowsIt) {
  EXPECT_EQ(word({}, {}), LiveAdvice::HoldStill);
  EXPECT_EQ(word({}, {40, 0, 560}), LiveAdvice::Right);
  EXPECT_EQ(word({}, {-40, 0, 560}), LiveAdvice::Left);
  EXPECT_EQ(word({}, {0, 25, 560}), LiveAdvice::Down);
  EXPECT_EQ(word({}, {0, -25, 560}), LiveAdvice::Up);
  EXPECT_EQ(word({}, {0, 0, 480}), LiveAdvice::Closer);
  EXPECT_EQ(word({}, {0, 0, 700}), LiveAdvice::Farther);
  EXPECT_EQ(word({}, {0, 0, 560, 30}), LiveAdvice::TiltLeft);
  EXPECT_EQ(word({}, {0, 0, 560, -30}), LiveAdvice::TiltRight);
  EXPECT_EQ(word({}, {0, 0, 560, 0, 30}), LiveAdvice::TiltForward);
  EXPECT_EQ(word({}, {0, 0, 560, 0, -30}), LiveAdvice::TiltBack);
  EXPECT_EQ(word({0, 0, 680}, {0, 0, 680, 0, 0, 25}), LiveAdvice::TurnClockwise);
  EXPECT_EQ(word({0, 0, 680}, {0, 0, 680, 0, 0, -25}), LiveAdvice::TurnCounterclockwise);
}

TEST(LiveAdvice, TheWholeWayIsOneSentence) {
  const auto way = [](const BoardAt& from, const BoardAt& to) {
    return pipeline::words_of(pipeline::words_towards(target_at(to), seen_at(from)));
  };
  EXPECT_EQ(way({}, {}), "");
  EXPECT_EQ(way({}, {0, 0, 480}), "closer");
  for (const char* word : {"closer", "lower left", "tilt back"})
    EXPECT_NE(way({0, 0, 700}, {-30, 20, 600, 0, -20}).find(word), std::string::npos) << word;
  EXPECT_EQ(pipeline::words_of(std::vector{LiveAdvice::Up, LiveAdvice::TiltLeft, LiveAdvice::Right}),
            "upper right, tilt left");
  EXPECT_EQ(pipeline::words_of(std::vector{LiveAdvice::Farther, LiveAdvice::Down}), "farther, down");
}

TEST(LiveAdvice, StaysWithOneAxisUntilItIsNearEnough) {
  pipeline::Guide guide;
  const auto target = target_at({40, 0, 560, 30});
  BoardAt at;
  const auto first = guide.towards(target, seen_at(at), room_at(at));
  ASSERT_TRUE(first);
  int changes = 0;
  LiveAdvice before = first->word;
  double farthest = first->how_far;
  for (int i = 0; i < 30; ++i) {
    const auto way = guide.towards(target, seen_at(at), room_at(at));
    if (!way) break;
    changes += way->word == before ? 0 : 1;
    before = way->word;
    (before == LiveAdvice::Right ? at.right_mm : at.yaw_deg) += 4;
    farthest = std::min(farthest, way->how_far);
  }
  EXPECT_FALSE(guide.towards(target, seen_at(at), room_at(at))) << "it arrives";
  EXPECT_LE(changes, 2);
  EXPECT_LT(farthest, 1.7);
}

// The tilts are those of the board, whatever else it does.
TEST(LiveAdvice, KnowsTheTiltsApart) {
  for (const double yaw : {-30.0, 0.0, 20.0})
    for (const double pitch : {-20.0, 0.0, 30.0}) {
      const auto seen = seen_at({10, -5, 680, yaw, pitch, 10});
      constexpr double kRad = 0.017453292519943295;
      EXPECT_NEAR(seen.tilt_across, std::sin(yaw * kRad) * std::cos(pitch * kRad), 0.06);
      EXPECT_NEAR(seen.tilt_down, std::sin(pitch * kRad), 0.06);
    }
}

// Every word leads to a place where both cameras still see the board.
TEST(LiveAdvice, LeadsNoBoardOutOfThePictures) {
  const BoardAt near_middle{0, 0, 570};
  const BoardAt far_below{0, 42, 700};
  EXPECT_EQ(word(near_middle, far_below), LiveAdvice::Farther);
  EXPECT_EQ(word(far_below, near_middle), LiveAdvice::Up);
}

// However the board is held, the words mean the picture.
TEST(LiveAdvice, DoesNotDependOnHowTheBoardIsHeld) {
  for (const double roll : {90.0, 180.0, -90.0}) {
    EXPECT_EQ(word({0, 0, 640, 0, 0, roll}, {0, 0, 640, 30, 0, roll}), LiveAdvice::TiltLeft) << roll;
    EXPECT_EQ(word({0, 0, 640, 0, 0, roll}, {0, 0, 640, 0, 30, roll}), LiveAdvice::TiltForward) << roll;
    EXPECT_EQ(word({0, 0, 640, 0, 0, roll}, {20, 0, 640, 0, 0, roll}), LiveAdvice::Right) << roll;
  }
}

TEST(LiveAdvice, TheOpeningAsksForEveryTiltOnce) {
  std::vector<pipeline::BoardParameters> taken;
  std::set<std::size_t> asked;
  const BoardAt poses[] = {{}, {0, 0, 560, 37}, {0, 0, 560, -37}, {0, 0, 560, 0, 37}, {0, 0, 560, 0, -37}};
  for (const BoardAt& at : poses) {
    const auto wanted = pipeline::opening_view(taken, {});
    asked.insert(wanted.number);
    pipeline::Guide guide;
    EXPECT_FALSE(guide.towards(wanted.target, seen_at(at), room_at(at))) << "this is what it asked for";
    taken.push_back(seen_at(at));
  }
  EXPECT_EQ(asked.size(), 5U);
  const std::size_t given_up[] = {pipeline::kOpeningNumber};
  EXPECT_NE(pipeline::opening_view({}, given_up).number, pipeline::kOpeningNumber);
}

// The advice comes first on the way, and the way is empty where there is nowhere to go.
TEST(LiveAdvice, TheWayBeginsWithTheAdvice) {
  HeldBoardCorners board(kiosk_rig(), kHeldPattern, 0.02, 1);
  auto collector = *pipeline::ViewCollector::begin(kHeldPattern, 1920, 1200, {});
  EXPECT_TRUE(collector.state().way.empty());
  int on_the_way = 0;
  for (double right_mm = 20; right_mm < 70; right_mm += 5) {
    ASSERT_TRUE(collector.consider(board.pair({right_mm, 30, 640, 30, 25, 15})));
    const auto& s = collector.state();
    EXPECT_EQ(s.way.empty(), s.how_far == 0);
    if (s.way.empty()) continue;
    EXPECT_EQ(s.way.front(), s.advice);
    EXPECT_EQ(std::set(s.way.begin(), s.way.end()).size(), s.way.size()) << "each word once";
    on_the_way += s.way.size() > 1 ? 1 : 0;
  }
  EXPECT_GE(on_the_way, 3);
}

// Held where it was told and yet nothing new: another view is asked for, and nobody waits for ever.
TEST(LiveAdvice, ATargetThatBringsNothingIsGivenUp) {
  HeldBoardCorners board(kiosk_rig(), kHeldPattern, 0.02, 1);
  auto collector = *pipeline::ViewCollector::begin(kHeldPattern, 1920, 1200, {});
  const auto hold = [&](const BoardAt& at) {
    for (int i = 0; i < 2; ++i) {
      const auto pair = board.pair(at);
      if (*collector.consider(pair)) {
        EXPECT_TRUE(collector.take(pair.seen[0].corners, pair.seen[1].corners));
      }
    }
  };
  hold({});
  hold({0, 0, 560, 24});  // taken half-way to the first tilt, which then is nothing new
  ASSERT_EQ(collector.state().views, 2);
  ASSERT_EQ(collector.state().advice, LiveAdvice::TiltLeft);
  for (int i = 0; i < 8 && collector.state().advice != LiveAdvice::TiltRight; ++i) hold({0, 0, 560, 31});
  EXPECT_EQ(collector.state().views, 2);
  EXPECT_EQ(collector.state().advice, LiveAdvice::TiltRight);
}

TEST(LiveAdvice, EveryWordHasAName) {
  for (int i = 0; i <= static_cast<int>(LiveAdvice::Done); ++i)
    EXPECT_STRNE(name_of(static_cast<LiveAdvice>(i)), "") << i;
  for (int i = 0; i <= static_cast<int>(pipeline::PairVerdict::Finished); ++i)
    EXPECT_STRNE(name_of(static_cast<pipeline::PairVerdict>(i)), "") << i;
  for (int i = 0; i <= static_cast<int>(pipeline::LiveEnd::Full); ++i)
    EXPECT_STRNE(name_of(static_cast<pipeline::LiveEnd>(i)), "") << i;
}

}  // namespace
}  // namespace relievo::tests

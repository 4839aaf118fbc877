// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A simulated head that turns: where it stands is known. And the advice by its rules.
#include "pipeline/gate/turn/turn_guide.h"

#include <gtest/gtest.h>

#include <bitset>
#include <cmath>
#include <numbers>

#include "pipeline/model/vector3.h"
#include "tests/support/gate_fixture.h"
#include "tests/support/proof.h"
#include "tests/support/turning_person.h"

namespace relievo::pipeline {
namespace {

using test::shared_album;
using test::standing;
using namespace std::chrono_literals;

FrontFace front_of(std::uint32_t seed, test::GateFixture& gate) {
  const GateLook look = gate.first_look(shared_album(), shared_album().shoot(seed, standing(560)));
  FrontFace face;
  front_face(look.relief, look.answer.measures.head, face);
  return face;
}

HeadTurn turned(std::uint32_t seed, const FrontFace& front, double yaw, double pitch, test::GateFixture& gate,
                const HeadTurn& before = {}) {
  const auto& shot = shared_album().shoot(seed, standing(560, 6, -4, yaw, pitch));
  return follow_head(front, gate.first_look(shared_album(), shot).relief, before);
}

TEST(HeadTurn, IsMeasuredToEitherSideFromAnywhere) {
  RELIEVO_MANY_TRIALS();
  test::GateFixture gate;
  for (const std::uint32_t seed : {5U, 11U}) {
    const FrontFace front = front_of(seed, gate);
    ASSERT_GT(front.count, 400U);
    for (const double yaw : {-45.0, -25.0, 0.0, 12.0, 25.0, 45.0}) {
      const HeadTurn turn = turned(seed, front, yaw, 0, gate);
      ASSERT_TRUE(turn.known) << seed << " " << yaw;
      EXPECT_NEAR(turn.yaw_deg, yaw, 3) << seed;
      EXPECT_NEAR(turn.pitch_deg, 0, 3) << seed << " " << yaw;
      EXPECT_NEAR(turn.roll_deg, 0, 3) << seed << " " << yaw;
    }
    EXPECT_NEAR(turned(seed, front, 0, 12, gate).pitch_deg, 12, 3) << seed;
  }
}

TEST(HeadTurn, IsFollowedFromWhereItWasAndAnotherPlaceIsNoHead) {
  test::GateFixture gate;
  const FrontFace front = front_of(5, gate);
  const HeadTurn at = turned(5, front, 25, 0, gate);
  const HeadTurn on = turned(5, front, 45, 0, gate, at);
  ASSERT_TRUE(on.known);
  EXPECT_NEAR(on.yaw_deg, 45, 3);
  // The simulated head turns about the middle of its face: what is 65 to 105 mm from there moves by this
  // much.
  const double by = 2 * std::sin(10 * std::numbers::pi / 180);
  EXPECT_GT(moved_mm(front, at, on), 55 * by);
  EXPECT_LT(moved_mm(front, at, on), 115 * by);
  EXPECT_EQ(moved_mm(front, at, at), 0);
  auto nobody = standing(560);
  nobody.distance_mm = 0;
  const auto look = gate.first_look(shared_album(), shared_album().shoot(5, nobody));
  EXPECT_FALSE(follow_head(front, look.relief, at).known);
  EXPECT_FALSE(follow_head({}, look.relief, {}).known) << "nobody was seen from the front";
}

// About the neck, as people do.
hal::sim::HeadPose about_the_neck(double yaw_deg) {
  constexpr double kNeckMm = 95;
  const double yaw = yaw_deg * std::numbers::pi / 180;
  hal::sim::HeadPose pose = standing(560);
  pose.yaw_deg += yaw_deg;
  pose.right_mm += kNeckMm * std::sin(yaw);
  pose.distance_mm += kNeckMm * (1 - std::cos(yaw));
  return pose;
}

// Fast heads and slow machines: from picture to picture it may be anywhere.
TEST(HeadTurn, IsFoundAgainWhereverItJumped) {
  RELIEVO_MANY_TRIALS();
  test::GateFixture gate;
  for (const std::uint32_t seed : {4U, 7U}) {
    const FrontFace front = front_of(seed, gate);
    HeadTurn before;
    for (const double yaw : {-25.0, -45.0, 25.0, 45.0, 0.0, 45.0, -45.0, -25.0, 0.0, 25.0, 0.0, -25.0}) {
      const GateLook look = gate.first_look(shared_album(), shared_album().shoot(seed, about_the_neck(yaw)));
      before = follow_head(front, look.relief, before);
      ASSERT_TRUE(before.known) << seed << " " << yaw;
      EXPECT_NEAR(before.yaw_deg, yaw, 3.5) << seed;
    }
  }
}

// --- the advice -------------------------------------------------------------------------------------
class TurnGuide : public testing::Test {
 protected:
  TurnGuide() {
    front_.count = 1;
    front_.points[0].at_mm = {0, 0, 500};
    front_.pivot_mm = {0, 0, 600};
  }
  // The next picture, a tenth of a second later, in which the place has moved so far.
  TurnAnswer look(double yaw, double moved = 0, double pitch = 0) {
    HeadTurn turn;
    turn.known = true;
    turn.yaw_deg = yaw, turn.pitch_deg = pitch;
    x_ += moved;
    turn.now_from_front.translation_mm.x = x_;
    now_ += 100ms;
    return guide_turn(front_, turn, now_, 10, history_);
  }
  FrontFace front_;
  TurnHistory history_;
  std::chrono::nanoseconds now_ = 1s;
  double x_ = 0;
};

TEST_F(TurnGuide, LeadsToTheNearestSideAndTakesItOnlyWhenTheHeadIsSlow) {
  EXPECT_EQ(look(-3).advice, TurnAdvice::ToLeft) << "the nearer one";
  EXPECT_EQ(look(1).advice, TurnAdvice::ToLeft);
  EXPECT_EQ(look(1.5).advice, TurnAdvice::ToLeft) << "about as far: what was asked for stays";
  EXPECT_EQ(look(2.5).advice, TurnAdvice::ToLeft);
  EXPECT_EQ(look(3.5).advice, TurnAdvice::ToRight) << "clearly nearer";
  EXPECT_EQ(look(12).advice, TurnAdvice::Slower) << "past the side before it is heard";
  EXPECT_EQ(look(22, 8).advice, TurnAdvice::Slower);
  EXPECT_FALSE(look(24, 8).take);
  EXPECT_FALSE(look(25, 0.2).take) << "one slow picture may be chance";
  const TurnAnswer answer = look(25, 0.2);
  EXPECT_EQ(answer.advice, TurnAdvice::Hold);
  ASSERT_TRUE(answer.take);
  EXPECT_EQ(kSidesDeg[*answer.take], 25);
  history_.taken.set(*answer.take);
  EXPECT_EQ(look(26).advice, TurnAdvice::ToRight) << "on to the next on this side";
  EXPECT_EQ(look(60).advice, TurnAdvice::ToLeft) << "too far";
  for (int i = 0; i < 2; ++i) EXPECT_EQ(look(45).advice, TurnAdvice::Hold);
  history_.taken.set(3);
  EXPECT_EQ(look(45).advice, TurnAdvice::ToLeft);
  history_.taken.set();
  EXPECT_EQ(look(0).advice, TurnAdvice::Done);
}

TEST_F(TurnGuide, AsksForTheOtherHandWhereOneDoesNotCome) {
  for (int i = 0; i < 60; ++i) EXPECT_EQ(look(5).advice, TurnAdvice::ToRight) << i;
  look(5), look(5);
  for (int i = 0; i < 60; ++i) EXPECT_EQ(look(5).advice, TurnAdvice::ToLeft) << i << ": though it is further";
  look(5), look(5);
  EXPECT_EQ(look(5).advice, TurnAdvice::ToRight) << "neither came: from the start";
  history_.taken.set(2), history_.taken.set(3);
  for (int i = 0; i < 150; ++i)
    EXPECT_EQ(look(5).advice, TurnAdvice::ToLeft) << i << ": nothing else is left";
}

TEST_F(TurnGuide, TakesNoNoddingOrLostHead) {
  for (int i = 0; i < 4; ++i) {
    const TurnAnswer nods = look(25, 0, 20);
    EXPECT_EQ(nods.advice, TurnAdvice::Level);
    EXPECT_FALSE(nods.take);
  }
  EXPECT_FALSE(look(25).take);
  EXPECT_EQ(guide_turn(front_, {}, now_ += 100ms, 10, history_).advice, TurnAdvice::Lost);
  EXPECT_FALSE(look(25).take) << "after it was lost nothing is known of its speed";
  EXPECT_FALSE(look(25).take);
  EXPECT_TRUE(look(25).take);
}

TEST_F(TurnGuide, TakesNothingFromTwoPicturesOfOneInstant) {
  look(25), look(25);
  now_ -= 90ms;
  EXPECT_FALSE(look(25).take) << "10 ms after the one before";
}

// A fast machine looks every 33 ms: between two looks that are too near to judge the page must not change.
TEST_F(TurnGuide, SaysTheSameUntilThereIsEnoughTimeToTell) {
  const auto soon = [&](double yaw, double pitch = 0) {
    now_ -= 67ms;
    return look(yaw, 0, pitch);
  };
  for (int i = 0; i < 10; ++i) EXPECT_EQ(soon(12).advice, TurnAdvice::ToRight) << i;
  for (int i = 0; i < 10; ++i) EXPECT_EQ(soon(12, 20).advice, TurnAdvice::Level) << i;
  EXPECT_EQ(guide_turn(front_, {}, now_ += 33ms, 10, history_).advice, TurnAdvice::Lost);
  EXPECT_NE(soon(12).advice, TurnAdvice::Lost) << "it is found";
}

// --- people ---------------------------------------------------------------------------------------
using test::TurningPerson;
using Kind = TurningPerson::Kind;

HeadTurn seen(TurningPerson& person, const FrontFace& front) {
  HeadTurn turn;
  if (person.is_gone()) return turn;
  turn.known = true;
  turn.yaw_deg = person.yaw_deg() + person.between(-0.3, 0.3);
  const double a = -turn.yaw_deg * std::numbers::pi / 180;
  turn.now_from_front.rotation = {{std::cos(a), 0, std::sin(a), 0, 1, 0, -std::sin(a), 0, std::cos(a)}};
  turn.now_from_front.translation_mm =
      plus(minus(front.pivot_mm, apply(turn.now_from_front.rotation, front.pivot_mm)), person.shift_mm());
  return turn;
}

// Places all over the face, about a neck.
FrontFace drawn_face() {
  FrontFace front;
  front.pivot_mm = {0, 0, 660};
  for (const Vec3d& at : {Vec3d{0, 0, 555}, Vec3d{-60, 10, 600}, Vec3d{60, 10, 600}, Vec3d{0, -80, 575}})
    front.points[front.count++].at_mm = at;
  return front;
}

struct Visit {
  std::bitset<kSides> taken;
  double seconds = 0, worst_mm_s = 0;  // the fastest head that was taken
};

// As the kiosk goes: eight looks a second, and enough when for 20 s no side has come.
Visit visit(Kind kind, std::uint32_t seed) {
  constexpr double kLookS = 0.125, kPatienceS = 20;
  const FrontFace front = drawn_face();
  TurningPerson person(kind, seed);
  TurnHistory history;
  Visit made;
  TurnAdvice said = TurnAdvice::Hold;
  HeadTurn before;
  for (double last = 0; !history.taken.all() && made.seconds - last < kPatienceS; made.seconds += kLookS) {
    person.hear(said, kLookS);
    const HeadTurn now_seen = seen(person, front);
    const auto now =
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(made.seconds + 1));
    const TurnAnswer answer = guide_turn(front, now_seen, now, 14, history);
    said = answer.advice;
    if (answer.take) {
      made.worst_mm_s = std::max(made.worst_mm_s, moved_mm(front, before, now_seen) / kLookS);
      history.taken.set(*answer.take);
      last = made.seconds;
    }
    before = now_seen;
  }
  made.taken = history.taken;
  return made;
}

// 1,000 visits: none goes on for ever, the willing end with both sides, and nobody is taken in motion.
TEST(TurnGuideVisits, TheWillingEndWithBothSides) {
  int willing = 0, both = 0, all = 0;
  double longest = 0;
  for (std::uint32_t seed = 0; seed < 1000; ++seed) {
    const auto kind = static_cast<Kind>(seed % static_cast<std::uint32_t>(Kind::Count));
    const Visit made = visit(kind, seed);
    longest = std::max(longest, made.seconds);
    EXPECT_LT(made.seconds, 90) << seed;
    EXPECT_LT(made.worst_mm_s, 25) << seed << ": 14, and what a picture's measure wanders";
    if (kind == Kind::Leaves) {
      EXPECT_LT(made.taken.count(), kSides) << seed;
    }
    if (kind == Kind::OneSide) {
      EXPECT_FALSE(made.taken[2] || made.taken[3]) << seed;
      EXPECT_TRUE(made.taken[0] || made.taken[1]) << seed << ": what there is";
    }
    if (!TurningPerson::is_willing(kind)) continue;
    ++willing;
    both += (made.taken[0] || made.taken[1]) && (made.taken[2] || made.taken[3]) ? 1 : 0;
    all += made.taken.all() ? 1 : 0;
  }
  RecordProperty("both", both);
  RecordProperty("all", all);
  RecordProperty("longest_s", std::to_string(longest));
  EXPECT_GE(both, 0.95 * willing) << "of " << willing;
  EXPECT_GE(all, 0.9 * willing) << "of " << willing << ", the longest visit took " << longest << " s";
}

}  // namespace
}  // namespace relievo::pipeline

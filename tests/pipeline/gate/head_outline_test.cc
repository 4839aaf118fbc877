// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Heads turned so far that they do not mirror themselves are told the right way round.
#include "pipeline/gate/head/head_outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tests/support/gate_fixture.h"

namespace relievo::pipeline {
namespace {

using test::Album;
using test::Developing;
using test::GateFixture;
using test::shared_album;
using test::Shot;
using test::standing;
using test::true_head;

TEST(HeadOutline, TellsToWhichSideAHeadLooksThatIsTurnedByFortyDegrees) {
  Album& album = shared_album();
  GateFixture gate;
  int told = 0;
  for (const double yaw : {-40.0, 40.0})
    for (const double roll : {-15.0, 0.0, 15.0}) {
      const Shot shot = album.photograph(301, standing(560, 0, 0, yaw, 0, roll));
      const GateLook look = gate.first_look(album, shot);
      const GateMeasures& m = look.answer.measures;
      ASSERT_TRUE(m.head.known) << yaw << " " << roll;
      EXPECT_GT(outline_yaw_deg(look.relief, m.head.tip_mm) * yaw, 0) << yaw << " " << roll;
      if (look.answer.reason != Advice::TurnedAside) continue;
      ++told;
      EXPECT_GT(m.head.yaw_deg * yaw, 0) << yaw << " " << roll;
    }
  EXPECT_GE(told, 5);
}

// Heads that bow, lean and turn, of which no cascade sees a face: now and then a cheek is taken for it, whose
// own mirror plane looks the other way.
TEST(HeadOutline, TellsTheSideOfAHeadWhoseCheekWasTakenForItsFace) {
  Album& album = shared_album();
  GateFixture gate;
  int told = 0;
  for (const auto& [person, pose] :
       {std::pair{305U, hal::sim::HeadPose{30, 20, 24, 605, 78, -37}}, {315U, {32, -10, 20, 580, 50, -56}}}) {
    const Shot shot = album.photograph(person, pose);
    for (std::uint64_t noise = 1; noise <= 8; ++noise) {
      Developing how;
      how.noise_seed = noise;
      const GateMeasures m = gate.first_look(album, shot, how).answer.measures;
      if (judge(m, Advice::None) != Advice::TurnedAside) continue;
      ++told;
      EXPECT_GT(m.head.yaw_deg, 0) << person << " " << noise << ": asymmetry " << m.head.asymmetry_mm;
    }
  }
  EXPECT_GE(told, 8);
}

TEST(HeadOutline, ShowsWhereTheHeadIsAndNobodyInAnEmptyRoom) {
  Album& album = shared_album();
  GateFixture gate;
  for (const double right : {-70.0, 0.0, 70.0}) {
    const Shot shot = album.photograph(301, standing(560, right, 10));
    const Somebody somebody = find_somebody(gate.first_look(album, shot).relief, 700);
    ASSERT_GT(somebody.head.width_px, 0);
    const GateLook look = gate.first_look(album, shot);
    const Vec2d tip = look.relief.pixel(true_head(shot, look.relief).tip_mm);
    EXPECT_NEAR(somebody.head.centre_px.x, tip.x, 0.2 * somebody.head.width_px) << right;
    EXPECT_NEAR(somebody.head.centre_px.y, tip.y, 0.35 * somebody.head.width_px) << right;
  }
  Shot empty = album.shoot(301, {.distance_mm = 0});
  EXPECT_EQ(find_somebody(gate.first_look(album, empty).relief, 700).head.width_px, 0);
}

}  // namespace
}  // namespace relievo::pipeline

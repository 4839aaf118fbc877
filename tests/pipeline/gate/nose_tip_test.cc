// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/gate_fixture.h"
#include "tests/support/proof.h"

namespace relievo::pipeline {
namespace {

constexpr double kTipErrorMm = 9;

struct NoseCase {
  const char* what;
  std::uint32_t person;
  hal::sim::HeadPose pose;  // yaw, pitch, roll, distance, right, down
  hal::sim::Expression expression;
};

// What is nearest to the cameras is the brow of a bowed head, its bridge or a tongue: none of them is the tip
// of the nose.
TEST(NoseTip, IsNeitherBrowNorBridgeNorTongue) {
  RELIEVO_MANY_TRIALS();
  test::Album& album = test::shared_album();
  test::GateFixture gate;
  for (const NoseCase& c :
       {NoseCase{"bowed, the mouth open", 72, {0.2, 6.5, 2.8, 630, -20, -10}, {1, 11, 0, 0}},
        NoseCase{"bowed, a smile", 73, {9.6, 5.3, -5.3, 626, -5, -4}, {1, 0, 0.79, 0}},
        NoseCase{"looks up, a tongue", 31, {7.1, -7, 2.2, 542, -17, -5}, {1, 12.6, 0, 20.1}}}) {
    const test::Shot& shot = album.shoot(c.person, c.pose, test::Extra::None, {c.expression, false, {}});
    const GateLook look = gate.first_look(album, shot);
    const HeadMeasurement& head = look.answer.measures.head;
    ASSERT_TRUE(head.known) << c.what;
    const test::TrueHead truth = test::true_head(shot, look.relief);
    const Vec3d off{head.tip_mm.x - truth.tip_mm.x, head.tip_mm.y - truth.tip_mm.y,
                    head.tip_mm.z - truth.tip_mm.z};
    EXPECT_LT(std::hypot(off.x, off.y, off.z), kTipErrorMm)
        << c.what << ": off by " << off.x << " right, " << off.y << " down, " << off.z << " away";
  }
}

}  // namespace
}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/support/gate_fixture.h"
#include "tests/support/proof.h"

namespace relievo::pipeline {
namespace {

// The cheek that turns away from rig and lamps is darker, however even the light; one lamp is told on the
// same head.
TEST(FaceLight, ATurnedCheekIsNoUnevenLight) {
  RELIEVO_MANY_TRIALS();
  test::Album& album = test::shared_album();
  test::GateFixture gate;
  const test::Shot& turned =
      album.shoot(32, {13.4, 0.8, 0.1, 514, 21, -14});  // by 8 degrees, from the rig's middle
  for (const double one_sided : {1.0, 0.05, 0.0}) {
    test::Developing how;
    how.one_sided = one_sided;
    const GateMeasures m = gate.first_look(album, turned, how).answer.measures;
    ASSERT_TRUE(m.light.known);
    EXPECT_NEAR(m.head.yaw_deg, 8, 4);
    if (one_sided == 1.0) EXPECT_GT(m.light.side_ratio, GateLimits{}.side_ratio);
    else EXPECT_LT(m.light.side_ratio, GateLimits{}.side_ratio) << one_sided;
  }
}

}  // namespace
}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstdlib>

#include "pipeline/gate/capture_gate.h"
#include "pipeline/workspace.h"
#include "tests/support/head_album.h"
#include "tests/support/proof.h"

namespace relievo::pipeline {
namespace {

// The cheek that turns away from rig and lamps is darker, however even the light; one lamp is told on the same head.
TEST(FaceLight, ATurnedCheekIsNoUnevenLight) {
  RELIEVO_MANY_TRIALS();
  test::Album album(std::getenv("RELIEVO_ALBUM") != nullptr ? std::getenv("RELIEVO_ALBUM") : "");
  Workspace work(2, std::size_t{8} << 20, std::size_t{64} << 20);
  CaptureGateOptions options;
  options.relief.reduction = 1;
  auto gate = CaptureGate::open(options);
  ASSERT_TRUE(gate);
  const test::Shot& turned = album.shoot(32, {13.4, 0.8, 0.1, 514, 21, -14});   // by 8 degrees, from the rig's middle
  for (const double one_sided : {1.0, 0.05, 0.0}) {
    test::Developing how;
    how.one_sided = one_sided;
    const auto pair = album.develop(turned, how);
    GateHistory history;
    work.output.reset();
    const auto look = run_stage(work.context, [&](StageContext& s) { return gate->look({pair.left.view(), pair.right.view()}, album.calibration(), GateTime{}, history, s); });
    ASSERT_TRUE(look && look->answer.measures.light.known);
    const GateMeasures& m = look->answer.measures;
    EXPECT_NEAR(m.head.yaw_deg, 8, 4);
    if (one_sided == 1.0) EXPECT_GT(m.light.side_ratio, GateLimits{}.side_ratio);
    else EXPECT_LT(m.light.side_ratio, GateLimits{}.side_ratio) << one_sided;
  }
}

}  // namespace
}  // namespace relievo::pipeline

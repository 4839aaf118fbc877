// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "pipeline/calibrate/quality/quality.h"
#include "tests/pipeline/calibrate/simulated_boards.h"
#include "tests/support/proof.h"

namespace relievo::tests {
namespace {

// Error over predicted sigma of every number of the calibration, on many rigs: were the sigmas true, it
// would be a standard normal deviate (but for k1, k2, k3, which the priors hold between the views).
TEST(ParameterUncertainty, ErrorsAreAsLargeAsSaid) {
  RELIEVO_MANY_TRIALS();
  constexpr int kRigs = 30;
  double lens = 0;
  double relation = 0;
  double baseline = 0;
  for (unsigned seed = 1; seed <= kRigs; ++seed) {
    const SimulatedRig rig = random_rig(seed);
    BoardSimulator boards(rig, 0.1, seed);
    boards.add(14);
    const auto done = pipeline::calibrate(boards.input());
    ASSERT_TRUE(done) << seed;
    const auto& u = done->quality.uncertainty.parameters;
    const std::array<const pipeline::CameraIntrinsics*, 2> cameras = {&done->calibration.left,
                                                                      &done->calibration.right};
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const std::array<double, 4> errors = {
          cameras[eye]->focal_px.x - rig.focal[eye], cameras[eye]->focal_px.y - rig.focal[eye],
          cameras[eye]->centre_px.x - rig.centre[eye][0], cameras[eye]->centre_px.y - rig.centre[eye][1]};
      for (std::size_t i = 0; i < 4; ++i) lens += std::pow(errors[i] / u.lens[eye][i], 2) / (8.0 * kRigs);
      for (std::size_t i = 4; i < 9; ++i) EXPECT_GT(u.lens[eye][i], 0);
    }
    const pipeline::Vec3d& t = done->calibration.right_from_left.translation_mm;
    const std::array<double, 3> errors = {t.x - rig.shift_mm[0], t.y - rig.shift_mm[1],
                                          t.z - rig.shift_mm[2]};
    for (std::size_t i = 0; i < 3; ++i)
      relation += std::pow(errors[i] / u.translation_mm[i], 2) / (3.0 * kRigs);
    const double truth = std::hypot(rig.shift_mm[0], rig.shift_mm[1], rig.shift_mm[2]);
    baseline += std::pow((done->quality.baseline_mm - truth) / u.baseline_mm, 2) / kRigs;
  }
  // The mean square of so many deviates, which a rig's own are not independent of each other: 1 within
  // four standard errors of the number of rigs.
  const double slack = 4 * std::sqrt(2.0 / kRigs);
  EXPECT_NEAR(lens, 1, slack);
  EXPECT_NEAR(relation, 1, slack);
  EXPECT_NEAR(baseline, 1, slack);
}

// The rotation vector of the rig is (turn) itself, so its error can be read off.
TEST(ParameterUncertainty, TurnsAreInDegrees) {
  RELIEVO_MANY_TRIALS();
  double square = 0;
  constexpr int kSets = 24;
  const SimulatedRig rig;
  const double angle = std::hypot(rig.turn[0], rig.turn[1], rig.turn[2]);
  for (unsigned seed = 1; seed <= kSets; ++seed) {
    BoardSimulator boards(rig, 0.1, 500 + seed);
    boards.add(12);
    const auto done = pipeline::calibrate(boards.input());
    ASSERT_TRUE(done);
    const auto& r = done->calibration.right_from_left.rotation.m;
    // About y, nearly all of this rig's turn.
    const double found = std::acos((r[0] + r[4] + r[8] - 1) / 2);
    square +=
        std::pow((found - angle) * 57.29577951308232 / done->quality.uncertainty.parameters.turn_deg[1], 2) /
        kSets;
  }
  EXPECT_NEAR(square, 1, 4 * std::sqrt(2.0 / kSets));
}

}  // namespace
}  // namespace relievo::tests

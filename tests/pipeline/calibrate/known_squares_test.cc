// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <gtest/gtest.h>

#include "pipeline/calibrate/calibrator.h"
#include "tests/pipeline/calibrate/simulated_boards.h"
#include "tests/support/proof.h"

namespace relievo::tests {
namespace {

using pipeline::CalibrationQuality;

CalibrationQuality quality_of(BoardSimulator& boards) {
  const auto done = pipeline::calibrate(boards.input());
  EXPECT_TRUE(done);
  return done ? done->quality : CalibrationQuality();
}

TEST(KnownSquares, ARigWithoutFaultFindsBoardsWhereTheyAre) {
  BoardSimulator boards(SimulatedRig{}, 0.001, 11);
  boards.add(14);
  const CalibrationQuality q = quality_of(boards);
  EXPECT_LT(q.measured_depth_mm, 0.02);
  EXPECT_LT(q.measured_point_depth_mm, 0.02);
  EXPECT_LT(q.measured_length_percent, 0.01);
  EXPECT_GT(q.measured_point_depth_mm, 0);
}

// Ten times the noise, ten times the error: it is measured, and nothing in it is a limit.
TEST(KnownSquares, GrowsWithTheNoise) {
  BoardSimulator little(SimulatedRig{}, 0.02, 12);
  BoardSimulator much(SimulatedRig{}, 0.2, 12);
  little.add(16);
  much.add(16);
  const CalibrationQuality a = quality_of(little);
  const CalibrationQuality b = quality_of(much);
  EXPECT_NEAR(b.measured_depth_mm / a.measured_depth_mm, 10, 3);
  EXPECT_NEAR(b.measured_point_depth_mm / a.measured_point_depth_mm, 10, 3);
  EXPECT_NEAR(b.measured_length_percent / a.measured_length_percent, 10, 3);
}

// A right camera that turns along the rows by `turn` misplaces depth by turn * z² / baseline, and leaves
// the epipolar lines alone.
TEST(KnownSquares, MeasureATurnThatEpipolarLinesDoNotShow) {
  RELIEVO_MANY_TRIALS();
  const SimulatedRig rig;
  BoardSimulator boards(rig, 0.02, 13);
  constexpr double kMost = 7e-4;
  constexpr int kViews = 40;
  // Evenly spread, in an order without a trend.
  double squares = 0;
  for (int i = 0; i < kViews; ++i) {
    const double turn = kMost * (2.0 * (i * 17 % kViews) / (kViews - 1) - 1);
    boards.add(Slip{{0, turn, 0}, {}, {}});
    squares += turn * turn;
  }
  const CalibrationQuality q = quality_of(boards);
  ASSERT_EQ(q.used, kViews) << "shaking that is usual";
  EXPECT_LT(q.held_out_epipolar_px, 0.15);
  // The baseline as seen from a point straight ahead of the left camera, at right angles to the line of
  // sight.
  const double expected =
      std::sqrt(squares / kViews) * pipeline::kFaceMm * pipeline::kFaceMm / std::abs(rig.shift_mm[0]);
  EXPECT_NEAR(q.measured_depth_mm, expected, 0.3 * expected);
  EXPECT_EQ(q.verdict, pipeline::CalibrationVerdict::Usable);
  bool said = false;
  for (const std::string& reason : q.reasons)
    said = said || reason.find("known size of their squares") != std::string::npos;
  EXPECT_TRUE(said);
}

}  // namespace
}  // namespace relievo::tests

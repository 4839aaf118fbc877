// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A deliberately bad set of every kind, each with the right reason; and none of them said of a good set.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "pipeline/calibrate/quality/quality_measures.h"
#include "tests/pipeline/calibrate/simulated_boards.h"
#include "tests/support/proof.h"

namespace relievo::tests {
namespace {

using pipeline::CalibrationQuality;
using pipeline::CalibrationVerdict;

bool says(const CalibrationQuality& q, std::string_view words) {
  return std::any_of(q.reasons.begin(), q.reasons.end(),
                     [&](const std::string& reason) { return reason.find(words) != std::string::npos; });
}

CalibrationQuality judged(const pipeline::CalibratorInput& input) {
  const auto done = pipeline::calibrate(input);
  EXPECT_TRUE(done) << done.error().what.view();
  return done ? done->quality : CalibrationQuality{};
}

TEST(Verdict, AGoodSetPassesAndNothingIsSaidAgainstIt) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    BoardSimulator boards(SimulatedRig{}, 0.03, seed);
    boards.add(24);
    boards.input().expected_baseline_mm = 114.8;
    const CalibrationQuality q = judged(boards.input());
    EXPECT_TRUE(q.holds_still);
    EXPECT_FALSE(q.board_bent) << q.board_sag_mm;
    EXPECT_EQ(q.moved_after, -1);
    for (const char* words :
         {"bent", "alike", "hold", "moved", "known to be", "agree with each other", "few"})
      EXPECT_FALSE(says(q, words)) << words << " seed " << seed;
  }
}

TEST(Verdict, AFigureThatIsNotANumberIsRefused) {
  BoardSimulator boards(SimulatedRig{}, 0.03, 1);
  boards.add(24);
  const CalibrationQuality good = judged(boards.input());
  ASSERT_NE(good.verdict, CalibrationVerdict::Refuse);
  for (const auto figure : {&CalibrationQuality::held_out_epipolar_px, &CalibrationQuality::shape_sigma_mm,
                            &CalibrationQuality::face_depth_sigma_mm, &CalibrationQuality::measured_depth_mm,
                            &CalibrationQuality::held_out_shift_px}) {
    CalibrationQuality q = good;
    q.reasons.clear();
    q.*figure = std::numeric_limits<double>::quiet_NaN();
    pipeline::judge_quality(q);
    EXPECT_EQ(q.verdict, CalibrationVerdict::Refuse);
    EXPECT_FALSE(says(q, "nan"));
  }
}

// Each camera sees another half of the board: nothing tells how well the two agree.
TEST(Verdict, WhatIsNotMeasuredIsNotPerfect) {
  BoardSimulator boards(SimulatedRig{}, 0.03, 2);
  boards.add(24);
  boards.input().pattern.kind = pipeline::BoardKind::Charuco;
  const int columns = boards.input().pattern.columns;
  constexpr double kUnseen = std::numeric_limits<double>::quiet_NaN();
  for (pipeline::BoardView& view : boards.input().views)
    for (std::size_t i = 0; i < view.left.size(); ++i)
      (int(i) % columns < columns / 2 ? view.right : view.left)[i] = {kUnseen, kUnseen};
  const CalibrationQuality q = judged(boards.input());
  EXPECT_EQ(q.verdict, CalibrationVerdict::Refuse);
  EXPECT_TRUE(says(q, "in both pictures"));
  EXPECT_TRUE(std::isnan(q.held_out_epipolar_px) && std::isnan(q.held_out_shift_px));
  EXPECT_TRUE(std::isnan(q.measured_depth_mm) && std::isnan(q.measured_length_percent));
  EXPECT_FALSE(says(q, "nan"));
}

TEST(Verdict, TooFew) {
  BoardSimulator boards(SimulatedRig{}, 0.05, 10);
  boards.add(6);
  const CalibrationQuality q = judged(boards.input());
  EXPECT_NE(q.verdict, CalibrationVerdict::Pass);
  EXPECT_TRUE(says(q, "6 pairs are few"));
}

TEST(Verdict, AllAlike) {
  BoardSimulator boards(SimulatedRig{}, 0.05, 11);
  boards.variety = 0.06;
  boards.add(14);
  const auto done = pipeline::calibrate(boards.input());
  if (!done) {
    EXPECT_EQ(done.error().code, Errc::PoorGeometry);
    return;
  }
  EXPECT_EQ(done->quality.verdict, CalibrationVerdict::Refuse);
  EXPECT_TRUE(says(done->quality, "held alike"));
}

TEST(Verdict, NotExposedTogether) {
  RELIEVO_MANY_TRIALS();
  for (unsigned seed = 1; seed <= 4; ++seed) {
    BoardSimulator boards(SimulatedRig{}, 0.05, 20 + seed);
    for (int i = 0; i < 16; ++i) {
      Slip slip;  // a hand that carries the board on at some 60 mm/s, 16 ms between the exposures
      for (double& mm : slip.carried_mm) mm = boards.normal(1.0);
      boards.add(slip);
    }
    const CalibrationQuality q = judged(boards.input());
    EXPECT_NE(q.verdict, CalibrationVerdict::Pass);
    EXPECT_EQ(q.slip_cause, pipeline::SlipCause::BoardCarried) << seed;
    EXPECT_TRUE(says(q, "same instant"));
  }
}

TEST(Verdict, CamerasThatShake) {
  RELIEVO_MANY_TRIALS();
  for (unsigned seed = 1; seed <= 4; ++seed) {
    BoardSimulator boards(SimulatedRig{}, 0.05, 30 + seed);
    for (int i = 0; i < 16; ++i) {
      Slip slip;
      for (double& turn : slip.turn) turn = boards.normal(0.003);
      boards.add(slip);
    }
    const CalibrationQuality q = judged(boards.input());
    EXPECT_NE(q.verdict, CalibrationVerdict::Pass);
    EXPECT_EQ(q.slip_cause, pipeline::SlipCause::CameraTurns) << seed;
    EXPECT_TRUE(says(q, "turn on their mounts"));
  }
}

TEST(Verdict, BumpedCamera) {
  BoardSimulator boards(SimulatedRig{}, 0.05, 40);
  boards.add(10);
  const Slip once = boards.random_slip(0.004, 0.5);
  for (int i = 0; i < 6; ++i) boards.add(once);
  const CalibrationQuality q = judged(boards.input());
  EXPECT_NE(q.verdict, CalibrationVerdict::Pass);
  EXPECT_EQ(q.moved_after, 9);
  EXPECT_TRUE(says(q, "a camera seems to have moved after view 9"));
}

TEST(Verdict, BentBoard) {
  for (const double bend_mm : {0.6, -0.6}) {
    BoardSimulator boards(SimulatedRig{}, 0.05, 50);
    boards.bend_mm = bend_mm;
    boards.add(16);
    const CalibrationQuality q = judged(boards.input());
    EXPECT_NE(q.verdict, CalibrationVerdict::Pass);
    EXPECT_TRUE(q.board_bent);
    EXPECT_NEAR(q.board_sag_mm, 0.6, std::max(0.15, 4 * q.board_sag_sigma_mm));
    EXPECT_TRUE(says(q, "the board is bent by"));
  }
}

TEST(Verdict, WrongSquareSize) {
  BoardSimulator boards(SimulatedRig{}, 0.05, 60);
  boards.add(16);
  boards.input().pattern.square_mm = 10.3;
  boards.input().expected_baseline_mm = 114.8;
  const CalibrationQuality q = judged(boards.input());
  EXPECT_EQ(q.verdict, CalibrationVerdict::Refuse);
  EXPECT_TRUE(says(q, "measure a square of the board again"));
}

// The rig in use is known again by its lenses, which a wrong square size leaves alone.
TEST(Verdict, WrongSquareSizeAgainstTheRigInUse) {
  BoardSimulator before(SimulatedRig{}, 0.05, 61);
  before.add(16);
  const auto in_use = pipeline::calibrate(before.input());
  ASSERT_TRUE(in_use);
  BoardSimulator boards(SimulatedRig{}, 0.05, 62);
  boards.add(16);
  boards.input().in_use = in_use->calibration;
  CalibrationQuality q = judged(boards.input());
  EXPECT_TRUE(q.expected_as_in_use);
  EXPECT_NEAR(q.expected_baseline_mm, in_use->quality.baseline_mm, 1e-9);
  EXPECT_NE(q.verdict, CalibrationVerdict::Refuse);
  boards.input().pattern.square_mm = 10.3;
  q = judged(boards.input());
  EXPECT_EQ(q.verdict, CalibrationVerdict::Refuse);
  EXPECT_TRUE(says(q, "measure a square of the board again"));
  boards.input().expected_baseline_mm = 1.03 * in_use->quality.baseline_mm;  // what is said counts more
  q = judged(boards.input());
  EXPECT_FALSE(q.expected_as_in_use);
  EXPECT_NE(q.verdict, CalibrationVerdict::Refuse);
}

TEST(Verdict, AnotherRigIsNotComparedWithTheOneInUse) {
  BoardSimulator boards(SimulatedRig{}, 0.05, 63);
  boards.add(16);
  const auto own = pipeline::calibrate(boards.input());
  ASSERT_TRUE(own);
  for (int difference = 0; difference < 3; ++difference) {
    pipeline::StereoCalibration other = own->calibration;
    other.right_from_left.translation_mm.x *= 1.5;
    if (difference == 0) other.left.focal_px.x *= 1.03;
    if (difference == 1) other.right.focal_px.y *= 0.97;
    if (difference == 2) other.right.width_px /= 2;
    boards.input().in_use = other;
    const CalibrationQuality q = judged(boards.input());
    EXPECT_EQ(q.expected_baseline_mm, 0) << difference;
    EXPECT_EQ(q.verdict, own->quality.verdict);
  }
}

TEST(Verdict, SwappedCameras) {
  BoardSimulator boards(SimulatedRig{}, 0.05, 70);
  boards.add(12);
  for (pipeline::BoardView& view : boards.input().views) std::swap(view.left, view.right);
  const auto done = pipeline::calibrate(boards.input());
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, Errc::PoorGeometry);
  EXPECT_NE(done.error().what.view().find("exchange the two"), std::string_view::npos);
}

TEST(Verdict, ABoardThatMovesInThePicture) {
  BoardSimulator boards(SimulatedRig{}, 0.6, 80);  // smeared corners
  boards.add(14);
  const CalibrationQuality q = judged(boards.input());
  EXPECT_NE(q.verdict, CalibrationVerdict::Pass);
  EXPECT_TRUE(says(q, "hold the board still"));
}

}  // namespace
}  // namespace relievo::tests

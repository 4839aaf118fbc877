// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The judgement against shifts drawn from its own model, and against what must never mislead it. With
// pictures: tests/bench/drift_proof.
#include "pipeline/calibrate/drift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <Eigen/Dense>

#include "pipeline/match/refine/refined_matcher.h"
#include "tests/support/bump_scene.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

StereoCalibration promising(double px) {
  StereoCalibration calibration;
  calibration.epipolar_shift_px = px;
  return calibration;
}

// A face 400 px wide that tells the offset to 0.01 px, the tilts to 0.02 px at its edge.
EpipolarShift seen(double offset, double tilt_x, double tilt_y) {
  EpipolarShift shift;
  shift.spread_x_px = 100, shift.spread_y_px = 130, shift.correlation = 0.3;
  shift.offset_px = offset, shift.slope_x = tilt_x / 100, shift.slope_y = tilt_y / 130;
  shift.covariance_px2 = {1e-4, 2e-5, 0, 4e-4, -5e-5, 4e-4};
  const Eigen::Vector3d field(offset, tilt_x, tilt_y);
  shift.residual_px = std::sqrt(field.squaredNorm() + 0.6 * tilt_x * tilt_y);
  shift.sigma_px = 0.03;
  return shift;
}

// An unmoved rig as the model has it: one draw of calibration and skin, one of the matches.
EpipolarShift unmoved(double promise, std::mt19937& random, bool one_way) {
  std::normal_distribution<double> normal(0, 1);
  const EpipolarShift like = seen(0, 0, 0);
  Eigen::Matrix3d c, m = Eigen::Matrix3d::Identity();
  const auto& v = like.covariance_px2;
  c << v[0], v[1], v[2], v[1], v[3], v[4], v[2], v[4], v[5];
  m(1, 2) = m(2, 1) = like.correlation;
  const double rms = std::hypot(promise, kSkinShiftPx);
  Eigen::Vector3d z(normal(random), normal(random), normal(random));
  if (one_way) z = {normal(random), 0, 0};  // all of the promise in the offset
  else z /= std::sqrt(3.0);
  const Eigen::Vector3d field =
      Eigen::Matrix3d(c.llt().matrixL()) * Eigen::Vector3d(normal(random), normal(random), normal(random)) +
      rms * Eigen::Matrix3d(m.inverse().llt().matrixL()) * z;
  return seen(field(0), field(1), field(2));
}

TEST(Drift, AnUnmovedRigIsLeftInPeace) {
  std::mt19937 random(3);
  for (const double promise : {0.005, 0.03, 0.2})
    for (const bool one_way : {false, true}) {
      int alarms = 0;
      for (int i = 0; i < 5000; ++i)
        alarms +=
            judge_drift(unmoved(promise, random, one_way), promising(promise)).verdict != DriftVerdict::Ok
                ? 1
                : 0;
      EXPECT_LE(alarms, 15) << promise << " px: 0.1 % of 5000, and a little chance";
    }
}

TEST(Drift, AFifthOfAPixelIsNoticed) {
  std::mt19937 random(4);
  for (const double promise : {0.005, 0.01, 0.02})
    for (const Eigen::Vector3d& way :
         {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(0.6, 0.8, 0)}) {
      int missed = 0;
      for (int i = 0; i < 5000; ++i) {
        const EpipolarShift base = unmoved(promise, random, false);
        const EpipolarShift moved =
            seen(base.offset_px + 0.2 * way(0), 100 * base.slope_x + 0.2 * way(1), 130 * base.slope_y);
        missed += judge_drift(moved, promising(promise)).verdict == DriftVerdict::Warn ? 0 : 1;
      }
      EXPECT_LE(missed, 50) << promise << " px promised, " << way.transpose();
    }
}

// What is promised counts: the same shift is news to a good calibration and none to a poor one.
TEST(Drift, ComparesWithWhatTheCalibrationPromises) {
  EXPECT_EQ(judge_drift(seen(0.2, 0, 0), promising(0.01)).verdict, DriftVerdict::Warn);
  EXPECT_EQ(judge_drift(seen(0.2, 0, 0), promising(0.2)).verdict, DriftVerdict::Ok);
  const DriftJudgement unsaid = judge_drift(seen(0.2, 0, 0), promising(0));
  EXPECT_EQ(unsaid.expected_px, kUnknownPromisePx);
  EXPECT_EQ(unsaid.verdict, DriftVerdict::Warn);
}

TEST(Drift, RefusesBeyondItsLimit) {
  const DriftJudgement far = judge_drift(seen(1.6, 0, 0), promising(0.02));
  EXPECT_EQ(far.verdict, DriftVerdict::Refuse);
  EXPECT_NE(sentence(far).find("calibrate again"), std::string::npos);
  EXPECT_EQ(judge_drift(seen(1.4, 0, 0), promising(0.02)).verdict, DriftVerdict::Warn);
  EXPECT_EQ(judge_drift(seen(-1.2, 1.2, 0), promising(0.02)).verdict, DriftVerdict::Refuse) << "rms counts";
}

TEST(Drift, AFaceThatTellsNothingIsNoVerdict) {
  EXPECT_EQ(judge_drift({}, promising(0.02)).verdict, DriftVerdict::Unknown);
  EpipolarShift vague = seen(0.1, 0, 0);
  for (double& c : vague.covariance_px2) c *= 100;
  vague.sigma_px = 0.3;
  EXPECT_EQ(judge_drift(vague, promising(0.02)).verdict, DriftVerdict::Unknown);
  vague.offset_px = vague.residual_px = 2;  // vague, and yet beyond doubt
  EXPECT_EQ(judge_drift(vague, promising(0.02)).verdict, DriftVerdict::Refuse);
  EpipolarShift broken = seen(0, 0, 0);
  broken.offset_px = std::nan("");
  EXPECT_EQ(judge_drift(broken, promising(0.02)).verdict, DriftVerdict::Unknown);
}

// From pictures to verdict, where the truth is in closed form.
TEST(Drift, SeesItInPicturesOfABump) {
  for (const double rows : {0.0, 0.2, -0.2, 1.8}) {
    test::StageFixture fixture(std::size_t{32} << 20, std::size_t{128} << 20);
    const RectifiedPair pair =
        test::BumpScene{.width_px = 240, .height_px = 200, .right_gain = 0.9, .seed = 5, .rows_px = rows}
            .render(&fixture.output);
    const Keypoints keypoints = test::lattice(pair, 8, &fixture.output);
    const auto matches = run_stage(
        fixture.context, [&](StageContext& c) { return RefinedMatcher({}).match(pair, keypoints, c); });
    ASSERT_TRUE(matches);
    const DriftJudgement judgement = judge_drift(matches->epipolar_shift, promising(0.01));
    EXPECT_EQ(judgement.verdict, rows == 0  ? DriftVerdict::Ok
                                 : rows > 1 ? DriftVerdict::Refuse
                                            : DriftVerdict::Warn)
        << rows;
    EXPECT_NEAR(judgement.residual_px, std::abs(rows), 0.05) << rows;
  }
}

}  // namespace
}  // namespace relievo::pipeline

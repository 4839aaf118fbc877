// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/calibrator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "pipeline/calibrate/file/calibration_file.h"
#include "pipeline/calibrate/report/calibration_report.h"
#include "tests/pipeline/calibrate/simulated_boards.h"
#include "tests/support/lying_sensor.h"
#include "tests/support/proof.h"

namespace relievo::tests {
namespace {

using pipeline::CalibrationVerdict;
using pipeline::CalibratorOutput;

double baseline(const pipeline::StereoCalibration& c) {
  const pipeline::Vec3d& t = c.right_from_left.translation_mm;
  return std::sqrt(t.x * t.x + t.y * t.y + t.z * t.z);
}

double true_baseline(const SimulatedRig& rig) {
  const Point& t = rig.shift_mm;
  return std::sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
}

TEST(Calibrator, FindsTheTrueRigFromPerfectCorners) {
  const SimulatedRig rig;
  BoardSimulator boards(rig, 0, 1);
  boards.add(15);
  const auto found = pipeline::calibrate(boards.input());
  ASSERT_TRUE(found) << found.error().what.view();
  const pipeline::StereoCalibration& c = found->calibration;
  EXPECT_NEAR(c.left.focal_px.x, rig.focal[0], 1e-4);
  EXPECT_NEAR(c.right.focal_px.y, rig.focal[1], 1e-4);
  EXPECT_NEAR(c.left.centre_px.x, rig.centre[0][0], 1e-4);
  EXPECT_NEAR(c.right.centre_px.y, rig.centre[1][1], 1e-4);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(c.left.distortion[i], rig.distortion[0][i], 5e-5);
  EXPECT_NEAR(c.right_from_left.translation_mm.x, rig.shift_mm[0], 1e-4);
  EXPECT_NEAR(c.right_from_left.translation_mm.z, rig.shift_mm[2], 1e-4);
  const Point x = turned(rig.turn, {1, 0, 0});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(c.right_from_left.rotation.m[3 * i], x[i], 1e-7);
  EXPECT_EQ(found->quality.used, 15);
}

// Cameras turned upright whose pictures nobody turns back: the same rig, lying on its side.
TEST(Calibrator, FindsARigOfLyingSensors) {
  const SimulatedRig rig;
  BoardSimulator boards(rig, 0.05, 2);
  boards.add(15);
  const auto upright = pipeline::calibrate(boards.input());
  ASSERT_TRUE(upright) << upright.error().what.view();
  for (const test::Side side : {test::Side::Clockwise, test::Side::Counterclockwise}) {
    pipeline::CalibratorInput input = boards.input();
    for (pipeline::BoardView& view : input.views)
      for (auto* corners : {&view.left, &view.right})
        for (auto& corner : *corners) corner = test::laid(corner, rig.width_px, rig.height_px, side);
    const auto found = pipeline::calibrate(input);
    ASSERT_TRUE(found) << found.error().what.view();
    const pipeline::StereoCalibration expected = test::laid(upright->calibration, side);
    EXPECT_EQ(found->quality.used, upright->quality.used);
    EXPECT_NEAR(found->calibration.left.focal_px.x, expected.left.focal_px.x, 0.05);
    EXPECT_NEAR(found->calibration.right.centre_px.y, expected.right.centre_px.y, 0.05);
    EXPECT_NEAR(found->calibration.right_from_left.translation_mm.x,
                expected.right_from_left.translation_mm.x, 0.01);
    EXPECT_NEAR(found->calibration.right_from_left.translation_mm.y,
                expected.right_from_left.translation_mm.y, 0.01);
    const auto read = pipeline::parse_calibration(pipeline::calibration_text(found->calibration));
    EXPECT_TRUE(read) << "what was calibrated can be read";
  }
}

// The noise of the corners and nothing else: no view may be called wrong.
TEST(Calibrator, KeepsAllViewsOfAFirmRig) {
  RELIEVO_MANY_TRIALS();
  const SimulatedRig rig;
  int left_out = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    BoardSimulator boards(rig, 0.08, seed);
    boards.add(16);
    const auto found = pipeline::calibrate(boards.input());
    ASSERT_TRUE(found) << found.error().what.view();
    left_out += 16 - found->quality.used;
    EXPECT_TRUE(found->quality.holds_still) << found->quality.slip_ratio;
    EXPECT_EQ(found->quality.moved_after, -1);
    EXPECT_NEAR(baseline(found->calibration), true_baseline(rig), 0.6);
    EXPECT_NEAR(found->quality.pair_rms_px, 0.08 * std::sqrt(2.0), 0.01);
    EXPECT_NE(found->quality.verdict, CalibrationVerdict::Refuse);
  }
  EXPECT_LE(left_out, 1) << "of 160 good views";
}

struct Disturbed {
  int good;
  int bad;
  double turn_rad;
  double baseline_tolerance_mm;  // five standard deviations or so
};

class CalibratorWithMovedViews : public ::testing::TestWithParam<Disturbed> {};

TEST_P(CalibratorWithMovedViews, NamesThemAllAndKeepsTheRest) {
  const SimulatedRig rig;
  const Disturbed& p = GetParam();
  int wrongly_out = 0;
  for (unsigned seed = 1; seed <= test::trials(5); ++seed) {
    BoardSimulator boards(rig, 0.08, 100 + seed);
    std::vector<bool> moved;
    for (int i = 0; i < p.good + p.bad; ++i) {
      // Spread evenly among the good ones.
      const bool bad = (i + 1) * p.bad / (p.good + p.bad) > i * p.bad / (p.good + p.bad);
      moved.push_back(bad);
      if (bad) boards.add(boards.random_slip(p.turn_rad, 0.5));
      else boards.add();
    }
    const auto found = pipeline::calibrate(boards.input());
    ASSERT_TRUE(found) << found.error().what.view();
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const pipeline::ViewQuality& view = found->quality.views[i];
      if (moved[i]) {
        EXPECT_FALSE(view.used) << "seed " << seed << " view " << i << " excess " << view.excess_px;
        EXPECT_NE(view.reason.find("disagree"), std::string::npos);
      } else if (!view.used) {
        ++wrongly_out;
      }
    }
    EXPECT_NEAR(baseline(found->calibration), true_baseline(rig), p.baseline_tolerance_mm) << "seed " << seed;
  }
  EXPECT_LE(wrongly_out, 1);
}

INSTANTIATE_TEST_SUITE_P(Shares, CalibratorWithMovedViews,
                         ::testing::Values(Disturbed{14, 1, 0.002, 0.8}, Disturbed{14, 3, 0.002, 0.8},
                                           Disturbed{11, 7, 0.002, 0.8}, Disturbed{10, 6, 0.01, 0.8},
                                           Disturbed{5, 1, 0.004, 2.5}));

// A rig that always shakes a little: that is said, and what shakes as usual stays in.
TEST(Calibrator, SaysThatARigDoesNotHoldStill) {
  RELIEVO_MANY_TRIALS();
  int left_out = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    BoardSimulator boards(SimulatedRig{}, 0.08, 200 + seed);
    for (int i = 0; i < 18; ++i) {
      Slip slip;
      for (double& turn : slip.turn) turn = boards.normal(0.0004);
      for (double& shift : slip.shift_mm) shift = boards.normal(0.1);
      boards.add(slip);
    }
    const auto found = pipeline::calibrate(boards.input());
    ASSERT_TRUE(found) << found.error().what.view();
    EXPECT_FALSE(found->quality.holds_still) << found->quality.slip_ratio;
    ASSERT_FALSE(found->quality.reasons.empty());
    left_out += 18 - found->quality.used;
  }
  EXPECT_LE(left_out, 10) << "of 108";
}

TEST(Calibrator, SaysWhenACameraMoved) {
  const SimulatedRig rig;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    BoardSimulator boards(rig, 0.08, 300 + seed);
    boards.add(11);
    const Slip once = boards.random_slip(0.003, 0.6);
    for (int i = 0; i < 7; ++i) boards.add(once);
    const auto found = pipeline::calibrate(boards.input());
    ASSERT_TRUE(found) << found.error().what.view();
    EXPECT_EQ(found->quality.moved_after, 10);
    EXPECT_EQ(found->quality.used, 11);
    EXPECT_NEAR(baseline(found->calibration), true_baseline(rig), 0.8);
  }
}

TEST(Calibrator, DropsAStrayCornerAndKeepsItsBoard) {
  BoardSimulator boards(SimulatedRig{}, 0.08, 5);
  boards.add(14);
  boards.input().views[3].right[7].x += 3;
  boards.input().views[9].left[20].y -= 2;
  const auto found = pipeline::calibrate(boards.input());
  ASSERT_TRUE(found) << found.error().what.view();
  EXPECT_EQ(found->quality.used, 14);
  EXPECT_EQ(found->quality.views[3].corners_dropped, 1);
  EXPECT_EQ(found->quality.views[9].corners_dropped, 1);
  EXPECT_NEAR(found->quality.pair_rms_px, 0.08 * std::sqrt(2.0), 0.01);
}

TEST(Calibrator, LeavesOutABoardThatIsNotFlat) {
  BoardSimulator boards(SimulatedRig{}, 0.08, 6);
  boards.add(14);
  for (std::size_t i = 0; i < 54; ++i)
    boards.input().views[4].left[i].x += 2.5 * std::sin(static_cast<double>(i));
  const auto found = pipeline::calibrate(boards.input());
  ASSERT_TRUE(found) << found.error().what.view();
  EXPECT_FALSE(found->quality.views[4].used);
  EXPECT_NE(found->quality.views[4].reason.find("flat board"), std::string::npos);
  EXPECT_EQ(found->quality.used, 13);
}

// A board of which nothing was used covers nothing, wherever it lay.
TEST(Calibrator, ABoardThatWasLeftOutWholeCoversNothing) {
  BoardSimulator boards(SimulatedRig{}, 0.08, 6);
  boards.add(14);
  pipeline::BoardView loose = boards.input().views[4];
  const auto before = pipeline::calibrate(boards.input());
  ASSERT_TRUE(before) << before.error().what.view();
  // Into the corner of the left picture, which no other board reaches.
  double right = 0, bottom = 0;
  for (const pipeline::Vec2d& at : loose.left) right = std::max(right, at.x), bottom = std::max(bottom, at.y);
  for (std::size_t i = 0; i < loose.left.size(); ++i) {
    loose.left[i].x += 1015 - right + 2.5 * std::sin(double(i));
    loose.left[i].y += 1015 - bottom;
  }
  boards.input().views.push_back(loose);
  const auto found = pipeline::calibrate(boards.input());
  ASSERT_TRUE(found) << found.error().what.view();
  ASSERT_NE(found->quality.views[14].reason.find("flat board"), std::string::npos);
  EXPECT_EQ(found->quality.coverage_left, before->quality.coverage_left);
  EXPECT_EQ(found->quality.coverage_right, before->quality.coverage_right);
}

TEST(Calibrator, TurnsABoardFoundTheOtherWayRound) {
  BoardSimulator boards(SimulatedRig{}, 0.05, 7);
  boards.add(12);
  for (const std::size_t view : {2U, 5U, 6U})
    std::reverse(boards.input().views[view].right.begin(), boards.input().views[view].right.end());
  const auto found = pipeline::calibrate(boards.input());
  ASSERT_TRUE(found) << found.error().what.view();
  EXPECT_EQ(found->quality.used, 12);
}

TEST(Calibrator, NamesViewsWithoutABoard) {
  BoardSimulator boards(SimulatedRig{}, 0.05, 8);
  boards.add(12);
  boards.input().views[1].left.clear();
  boards.input().views[2].right.clear();
  boards.input().views[3].left.clear();
  boards.input().views[3].right.clear();
  const auto found = pipeline::calibrate(boards.input());
  ASSERT_TRUE(found) << found.error().what.view();
  EXPECT_EQ(found->quality.used, 9);
  EXPECT_EQ(found->quality.views[1].reason, "no board found in left");
  EXPECT_EQ(found->quality.views[2].reason, "no board found in right");
  EXPECT_EQ(found->quality.views[3].reason, "no board found in left and right");
}

TEST(Calibrator, SaysAllThatIsWrongWithAView) {
  BoardSimulator boards(SimulatedRig{}, 0.08, 6);
  boards.add(16);
  const auto loosen = [](pipeline::BoardCorners& corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i].x += 2.5 * std::sin(static_cast<double>(i));
  };
  boards.input().views[2].right.clear();
  loosen(boards.input().views[2].left);
  loosen(boards.input().views[4].left);
  loosen(boards.input().views[4].right);
  const auto found = pipeline::calibrate(boards.input());
  ASSERT_TRUE(found) << found.error().what.view();
  const auto says = [&](std::size_t view, std::string_view words) {
    return found->quality.views[view].reason.find(words) != std::string::npos;
  };
  EXPECT_TRUE(says(2, "no board found in right; left: ")) << found->quality.views[2].reason;
  EXPECT_TRUE(says(4, "left: ") && says(4, "; right: ")) << found->quality.views[4].reason;
}

// A board that moved between the exposures disagrees by as much, however many of its corners are seen.
TEST(Calibrator, TellsTheDisagreementOfTheCornersThatWereSeen) {
  constexpr std::size_t kMoved = 5;
  BoardSimulator boards(SimulatedRig{}, 0.02, 12);
  boards.add(static_cast<int>(kMoved));
  boards.add(boards.random_slip(0.006, 1));
  boards.add(12);
  const auto excess_px = [&] {
    const auto found = pipeline::calibrate(boards.input());
    EXPECT_TRUE(found) << found.error().what.view();
    return found ? found->quality.views[kMoved].excess_px : 0;
  };
  const double of_all = excess_px();
  ASSERT_GT(of_all, 0.5);
  for (pipeline::BoardView& view : boards.input().views)
    for (pipeline::BoardCorners* corners : {&view.left, &view.right})
      for (std::size_t i = 0; i < corners->size(); i += 2) (*corners)[i] = {std::nan(""), std::nan("")};
  EXPECT_NEAR(excess_px() / of_all, 1, 0.15);
}

TEST(Calibrator, GivesTheSameTwice) {
  BoardSimulator boards(SimulatedRig{}, 0.08, 9);
  boards.add(10);
  const auto one = pipeline::calibrate(boards.input());
  const auto two = pipeline::calibrate(boards.input());
  ASSERT_TRUE(one && two);
  EXPECT_EQ(pipeline::calibration_text(one->calibration), pipeline::calibration_text(two->calibration));
  const pipeline::CalibratorInput& input = boards.input();
  EXPECT_EQ(pipeline::calibration_report_json({input, *one, {}, {}, {}, {}}),
            pipeline::calibration_report_json({input, *two, {}, {}, {}, {}}));
  EXPECT_EQ(pipeline::calibration_report_html({input, *one, {}, {}, {}, {}}),
            pipeline::calibration_report_html({input, *two, {}, {}, {}, {}}));
}

TEST(Calibrator, RefusesWhatCannotBeCalibrated) {
  BoardSimulator few(SimulatedRig{}, 0.05, 10);
  few.add(4);
  EXPECT_EQ(pipeline::calibrate(few.input()).error().code, Errc::PoorGeometry);
  EXPECT_EQ(pipeline::calibrate({{9, 6, 10}, 1024, 1024, {}}).error().code, Errc::PoorGeometry);

  BoardSimulator wrong(SimulatedRig{}, 0.05, 11);
  wrong.add(8);
  wrong.input().views[2].left.pop_back();
  EXPECT_EQ(pipeline::calibrate(wrong.input()).error().code, Errc::InvalidInput);
  wrong.input().views[2].left.emplace_back(pipeline::Vec2d{std::numeric_limits<double>::infinity(), 0});
  EXPECT_EQ(pipeline::calibrate(wrong.input()).error().code, Errc::InvalidInput);
  wrong.input().views[2].left.back() = {0, 0};
  wrong.input().pattern = {6, 6, 10};
  EXPECT_EQ(pipeline::calibrate(wrong.input()).error().code, Errc::InvalidInput);
}

// The same view again and again determines nothing: an error or a verdict, never a confident rig.
TEST(Calibrator, DoesNotTrustViewsThatAreAllTheSame) {
  BoardSimulator boards(SimulatedRig{}, 0.05, 12);
  boards.add();
  const pipeline::BoardView view = boards.input().views.front();
  for (int i = 0; i < 9; ++i) boards.input().views.push_back(view);
  const auto found = pipeline::calibrate(boards.input());
  EXPECT_TRUE(!found || found->quality.verdict != CalibrationVerdict::Pass);
}

}  // namespace
}  // namespace relievo::tests

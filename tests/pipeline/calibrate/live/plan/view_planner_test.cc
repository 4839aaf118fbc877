// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/view_planner.h"

#include <gtest/gtest.h>

#include "tests/pipeline/calibrate/live/held_board.h"

namespace relievo::tests {
namespace {

class Planner : public ::testing::Test {
 protected:
  Planner() {
    input_.pattern = kHeldPattern;
    input_.width_px = 1920;
    input_.height_px = 1200;
    const BoardAt opening[] = {
        {}, {0, 0, 560, 30}, {0, 0, 560, -30}, {0, 0, 560, 0, 30}, {0, 0, 560, 0, -30}, {10, 0, 600, 20, 20}};
    for (const BoardAt& at : opening) add(board_.seen(0, at).corners, board_.seen(1, at).corners);
  }
  void add(const pipeline::BoardCorners& left, const pipeline::BoardCorners& right) {
    input_.views.push_back({"", left, right});
    parameters_.push_back({pipeline::parameters_of(left, kHeldPattern, 1920, 1200),
                           pipeline::parameters_of(right, kHeldPattern, 1920, 1200)});
    coverage_[0].add(left, parameters_.back()[0], 1920, 1200);
    coverage_[1].add(right, parameters_.back()[1], 1920, 1200);
  }
  pipeline::ViewPlan plan(const pipeline::LiveOptions& options, std::span<const std::size_t> excluded = {}) {
    calibrated_ = pipeline::calibrate(input_);
    EXPECT_TRUE(calibrated_);
    EXPECT_TRUE(planner_.update(input_, *calibrated_, error_mm(), parameters_, coverage_, options));
    return planner_.plan(excluded);
  }
  double error_mm() const { return calibrated_->quality.uncertainty.depth[3].sigma_mm; }  // 550 mm
  std::vector<pipeline::CandidatePose> candidates(int quarter_turns = 0) {
    if (!calibrated_) calibrated_ = pipeline::calibrate(input_);
    return pipeline::candidate_poses(pipeline::rig_problem(calibrated_->calibration, kHeldPattern), 560,
                                     quarter_turns);
  }
  // The error after one more view, seen with the noise of the others.
  double error_with(const pipeline::CandidatePose& pose) {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0, kNoisePx);
    pipeline::CalibratorInput more = input_;
    more.views.push_back({"", pose.corners[0], pose.corners[1]});
    for (auto* corners : {&more.views.back().left, &more.views.back().right})
      for (auto& at : *corners) at = {at.x + noise(random), at.y + noise(random)};
    const auto done = pipeline::calibrate(more);
    EXPECT_TRUE(done);
    return done ? done->quality.uncertainty.depth[3].sigma_mm : 0;
  }

  static constexpr double kNoisePx = 0.05;
  HeldBoardCorners board_{kiosk_rig(), kHeldPattern, kNoisePx, 3};
  pipeline::CalibratorInput input_;
  std::vector<std::array<pipeline::BoardParameters, 2>> parameters_;
  std::array<pipeline::Coverage, 2> coverage_;
  pipeline::ViewPlanner planner_;
  Result<pipeline::CalibratorOutput> calibrated_ = Error{Errc::NotCalibrated, "not yet"};
};

TEST_F(Planner, EveryCandidateIsSeenWholeByBothCameras) {
  for (const int quarter : {0, 1}) {
    const auto poses = candidates(quarter);
    EXPECT_GT(poses.size(), 80U);
    for (const auto& pose : poses)
      for (const auto& corners : pose.corners)
        for (const auto& at : corners) {
          EXPECT_GT(at.x, 50);
          EXPECT_GT(at.y, 50);
          EXPECT_LT(at.x, 1870);
          EXPECT_LT(at.y, 1150);
        }
  }
}

// The gain that is predicted is the one that comes, and it is larger than that of most other views.
TEST_F(Planner, APlannedViewLowersTheErrorAsItSays) {
  pipeline::LiveOptions options;
  options.goal_mm = 0.001;
  options.full_bar = 0;  // for the error alone
  const auto planned = plan(options);
  ASSERT_TRUE(planned.best);
  ASSERT_GT(planned.best_gain, 0.05);
  double best = 0;
  std::vector<double> others;
  const auto poses = candidates();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (poses[i].number == planned.best->number) best = error_with(poses[i]);
    else if (i % 12 == 0) others.push_back(error_with(poses[i]));
  }
  ASSERT_GT(best, 0);
  EXPECT_NEAR(1 - best / error_mm(), planned.best_gain, 0.08);
  std::sort(others.begin(), others.end());
  EXPECT_LT(best, others[others.size() / 10] * 1.03);
}

TEST_F(Planner, EmptyBarsAreFilledWhenTheGoalIsReached) {
  pipeline::LiveOptions options;
  options.goal_mm = 100;
  const auto planned = plan(options);
  ASSERT_TRUE(planned.best);
  EXPECT_GT(planned.best_bar_gain, 0.1);
  const auto before = lesser(coverage_[0].bars(), coverage_[1].bars());
  for (const auto& pose : candidates()) {
    if (pose.number != planned.best->number) continue;
    const auto after =
        lesser(coverage_[0].bars_with(pipeline::parameters_of(pose.corners[0], kHeldPattern, 1920, 1200)),
               coverage_[1].bars_with(pipeline::parameters_of(pose.corners[1], kHeldPattern, 1920, 1200)));
    EXPECT_GT(after.x + after.y + after.skew, before.x + before.y + before.skew + 0.1);
  }
}

TEST_F(Planner, AViewInHandIsWorthWhatItWasPlannedFor) {
  const auto planned = plan({});
  ASSERT_TRUE(planned.best);
  for (const auto& pose : candidates()) {
    if (pose.number != planned.best->number) continue;
    EXPECT_NEAR(planner_.worth(pose.corners[0], pose.corners[1]), planned.best_worth, 1e-6);
  }
  const auto known = planner_.worth(input_.views[0].left, input_.views[0].right);
  EXPECT_GT(known, 0);
  EXPECT_LT(known, 0.5 * planned.best_worth) << "the same view again";
}

TEST_F(Planner, WhatIsExcludedOrKnownIsNotPlanned) {
  pipeline::LiveOptions options;
  const auto first = plan(options);
  ASSERT_TRUE(first.best);
  const std::size_t excluded[] = {first.best->number};
  const auto second = plan(options, excluded);
  ASSERT_TRUE(second.best);
  EXPECT_NE(second.best->number, first.best->number);
  for (const auto& pose : candidates())
    if (pose.number == first.best->number) add(pose.corners[0], pose.corners[1]);
  const auto third = plan(options);
  ASSERT_TRUE(third.best);
  EXPECT_NE(third.best->number, first.best->number);
}

// A planner that knows no answer says nothing of what further views would bring.
TEST(EndOf, IsWhereNoFurtherViewHelps) {
  using pipeline::LiveEnd;
  EXPECT_EQ(pipeline::end_of({}, false, 0.02), LiveEnd::NotYet);
  EXPECT_EQ(pipeline::end_of({}, true, 0.02), LiveEnd::NotYet);
  const auto end = [](double gain, double bar_gain, bool reached) {
    return pipeline::end_of(pipeline::ViewPlan{{}, 1, gain, bar_gain}, reached, 0.02);
  };
  EXPECT_EQ(end(0.01, 0.01, false), LiveEnd::Plateau);
  EXPECT_EQ(end(0.01, 0.01, true), LiveEnd::GoalReached);
  EXPECT_EQ(end(0.03, 0.01, false), LiveEnd::NotYet);
  EXPECT_EQ(end(0.03, 0.01, true), LiveEnd::GoalReached) << "the error is small enough";
  EXPECT_EQ(end(0.01, 0.03, true), LiveEnd::NotYet) << "a bar is still to be filled";
}

}  // namespace
}  // namespace relievo::tests

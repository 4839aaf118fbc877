// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The technician's page of calibrations, by touch: made, judged, stored, used, taken along on a stick.
#include "tests/firmware/technician/technician_fixture.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "hal/sim/optics/rig.h"
#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "tests/firmware/busy_lane.h"

namespace relievo::firmware {
namespace {

TEST_F(TechnicianTest, ACalibrationIsMadeJudgedStoredAndUsed) {
  rig().open(StaffPage::Calibrate);
  rig().tap("columns less");
  EXPECT_EQ(rig().now().calibration.columns, 9);
  rig().tap("columns more");
  ASSERT_TRUE(rig().until([] { return rig().now().calibration.history_count > 0; }));
  const std::size_t count = rig().now().calibration.history_count;
  const std::uint32_t newest = rig().now().calibration.history[0].revision;
  ASSERT_NO_FATAL_FAILURE(calibrate());
  const ui::TechnicianCalibration made = rig().now().calibration;
  ASSERT_NE(made.verdict, pipeline::CalibrationVerdict::Refuse)
      << (made.reasons.empty() ? "" : made.reasons.front());
  ASSERT_FALSE(made.reasons.empty()) << "good for a reason that is told, too";
  const auto& between = rig().stages->calibration()->right_from_left.translation_mm;
  EXPECT_NEAR(made.baseline_mm, std::hypot(between.x, between.y, between.z), 0.5);
  EXPECT_EQ(rig().appliance->state(), State::Staff);

  rig().disk_full = true;
  rig().tap("calibration store");
  ASSERT_TRUE(rig().until([] { return !rig().now().calibration.problem.empty(); }));
  EXPECT_FALSE(rig().now().calibration.stored) << "and is there to be stored once there is room";
  rig().disk_full = false;
  rig().tap("calibration store");
  ASSERT_TRUE(rig().until([&] { return rig().now().calibration.history_count == count + 1; }))
      << rig().now().calibration.problem.detail;
  EXPECT_EQ(rig().revision, newest + 1);
  EXPECT_EQ(rig().log.entries().back().event, ui::LogEvent::CalibrationUsed);
  EXPECT_EQ(rig().stages->calibration()->revision, newest + 1) << "visitors are measured with it";
  EXPECT_EQ(rig().store->active_calibration()->revision, newest + 1);
  char error[24];
  std::snprintf(error, sizeof error, "%.3f", double(rig().now().calibration.history[0].depth_error_mm));
  EXPECT_TRUE(std::ranges::any_of(rig().screen->tree().nodes(), [&](const ui::Node& node) {
    return node.text.find("in force") != std::string_view::npos &&
           node.text.find(error) != std::string_view::npos;
  })) << "its error stands beside it";
  // The one before it comes back by a touch.
  rig().tap("calibration 1");
  ASSERT_TRUE(rig().until([&] { return rig().revision == newest; }))
      << rig().now().calibration.problem.detail;
  EXPECT_EQ(rig().stages->calibration()->revision, newest);

  // By stick: what was exported comes back as one more of the history.
  rig().plug_in();
  const auto other = rig().stick() / "calibrations" / ("000" + std::to_string(newest)) / "rig.yml";
  std::filesystem::create_directories(other.parent_path());
  std::ofstream(other) << "another appliance's";
  rig().tap("calibration export");
  ASSERT_TRUE(rig().until([] { return !rig().now().calibration.exported.empty(); }))
      << rig().now().calibration.problem.detail;
  const auto exported = rig().stick() / rig().now().calibration.exported;
  EXPECT_TRUE(std::filesystem::exists(exported)) << exported;
  EXPECT_EQ(std::filesystem::file_size(other), 19U) << "of the same revision: it stays";
  rig().plug_in();
  rig().tap("calibration import");
  ASSERT_TRUE(rig().until([&] { return rig().now().calibration.history_count == count + 2; }))
      << rig().now().calibration.problem.detail;
  EXPECT_EQ(rig().store->active_calibration()->right_from_left.translation_mm.x,
            rig().store->calibration(newest)->right_from_left.translation_mm.x);
  std::filesystem::remove_all(rig().stick() / "calibrations");
}

// They would be thrown away.
TEST_F(TechnicianTest, FewerViewsThanAVerdictNeedsCannotBeDone) {
  std::atomic<bool> looked{false};
  rig().spoils = [&looked](const pipeline::LiveState& state) -> Result<bool> {
    while (state.views == pipeline::kMinBoardPairs - 1 && !looked)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return false;
  };
  rig().open(StaffPage::Calibrate);
  rig().tap("calibration begin");
  EXPECT_TRUE(rig().until([] { return rig().now().calibration.views == pipeline::kMinBoardPairs - 1; }));
  EXPECT_TRUE(rig().shows("calibration cancel"));
  EXPECT_FALSE(rig().shows("calibration finish"));
  looked = true;
  EXPECT_TRUE(rig().until([] { return rig().shows("calibration finish"); }));
  EXPECT_GE(rig().now().calibration.views, pipeline::kMinBoardPairs);
  rig().tap("calibration cancel");
  ASSERT_TRUE(rig().until([] { return !rig().now().calibration.running; }));
  rig().spoils = {};
}

// Somebody has changed the cameras' mode: the views before are worth their verdict all the same.
TEST_F(TechnicianTest, WhatEndedACalibrationStandsAboveItsVerdict) {
  rig().spoils = [](const pipeline::LiveState& state) -> Result<bool> { return state.views >= 7; };
  rig().open(StaffPage::Calibrate);
  rig().tap("calibration begin");
  ASSERT_TRUE(rig().until([] { return rig().appliance->state() == State::Calibrate; }));
  ASSERT_TRUE(rig().until([] { return !rig().now().calibration.running; }));
  EXPECT_TRUE(rig().now().calibration.ended);
  EXPECT_EQ(rig().now().calibration.problem.code, Errc::InvalidInput);
  rig().turn();
  EXPECT_TRUE(rig().shows("verdict"));
  EXPECT_TRUE(rig().says("another size"));
  rig().spoils = {};
}

// Cameras at another distance than the calibration in use says are refused, unless the technician says why.
TEST_F(TechnicianTest, CamerasThatWereMountedAnewMayHaveAnotherDistance) {
  const std::uint32_t own = rig().stages->calibration()->revision;
  const auto& rows = rig().now().calibration.history;
  const auto file = rig().folder.path() / "boards.yml";
  ASSERT_TRUE(hal::sim::write_rig(file, hal::sim::make_rig(rig().boards)).has_value());
  const auto before = rig().store->save_calibration(*pipeline::read_calibration(file), "of the boards' rig");
  ASSERT_TRUE(before.has_value());
  // As on a device of those cameras.
  rig().stages->replace(
      *pipeline::Pipeline::make(rig().stages->algorithms(), *rig().store->calibration(*before)));
  rig().open(StaffPage::Calibrate);
  ASSERT_TRUE(rig().until([&] { return rows[0].revision == *before; }));
  rig().boards.baseline_mm *= 1.1;
  ASSERT_NO_FATAL_FAILURE(calibrate());
  EXPECT_EQ(rig().now().calibration.verdict, pipeline::CalibrationVerdict::Refuse);
  EXPECT_NE(rig().now().calibration.reasons.front().find("mm apart"), std::string::npos);
  EXPECT_FALSE(rig().shows("calibration store"));
  rig().tap("mounted");
  ASSERT_NO_FATAL_FAILURE(calibrate());
  EXPECT_NE(rig().now().calibration.verdict, pipeline::CalibrationVerdict::Refuse);
  EXPECT_NEAR(rig().now().calibration.baseline_mm, rig().boards.baseline_mm, 2);
  rig().tap("calibration store");
  ASSERT_TRUE(rig().until([&] { return rows[0].active && rows[0].revision > *before; }));
  EXPECT_FALSE(rig().now().calibration.mounted_anew) << "said of one calibration only";
  // Back to the one that fits the test captures.
  rig().boards.baseline_mm /= 1.1;
  const auto row = std::ranges::find(rows, own, &ui::TechnicianCalibrationRow::revision);
  ASSERT_NE(row, rows.end());
  rig().tap("calibration " + std::to_string(row - rows.begin()));
  ASSERT_TRUE(rig().until([&] { return rig().revision == own; }));
}

// Visitors could not be measured with it.
TEST_F(TechnicianTest, ACalibrationForPicturesOfAnotherSizeComesIntoUseByNoWay) {
  rig().open(StaffPage::Calibrate);
  const auto done = [] { return !rig().side_tasks->busy(JobLane::Keeper); };
  ASSERT_TRUE(rig().until(done));
  const std::uint32_t own = rig().store->active_calibration()->revision;
  const std::size_t count = rig().store->calibrations()->size();
  const auto file = rig().stick() / "rig.yml";
  ASSERT_TRUE(hal::sim::write_rig(file, hal::sim::make_rig(rig().boards)).has_value());
  rig().plug_in();
  rig().tap("calibration import");
  ASSERT_TRUE(rig().until(done));
  EXPECT_EQ(rig().store->calibrations()->size(), count);
  const ui::Fault problem = rig().now().calibration.problem;
  EXPECT_EQ(problem.code, Errc::InvalidInput);
  for (const hal::sim::RigOptions& rig_of : {rig().boards, test::small_rig(test_technician::kScale)})
    EXPECT_NE(problem.detail.find(std::to_string(rig_of.width_px) + "x" + std::to_string(rig_of.height_px)),
              std::string::npos)
        << problem.detail;

  // One that the command line has stored.
  const auto stored = rig().store->save_calibration(*pipeline::read_calibration(file), "of the boards' rig");
  std::filesystem::remove(file);
  ASSERT_TRUE(stored.has_value());
  ASSERT_TRUE(rig().store->activate_calibration(own).has_value());
  rig().open(StaffPage::Calibrate);
  ASSERT_TRUE(rig().until([&] { return rig().now().calibration.history[0].revision == *stored; }));
  rig().tap("calibration 0");
  ASSERT_TRUE(rig().until(done));
  EXPECT_EQ(rig().store->active_calibration()->revision, own);
  EXPECT_NE(rig().revision, *stored);
}

// Out of sight it would hold the cameras that the other pages need. What was made before can be compared.
TEST_F(TechnicianTest, WhoLeavesTheirCalibrationEndsItAndFindsItAgain) {
  ASSERT_NO_FATAL_FAILURE(capture());
  const std::size_t before = rig().now().put_aside;
  const std::string name(rig().now().result.name);
  rig().open(StaffPage::Calibrate);
  rig().tap("calibration begin");
  ASSERT_TRUE(
      rig().until([] { return rig().now().calibration.views >= 7 || !rig().now().calibration.running; }));
  rig().open(StaffPage::Cameras);
  ASSERT_TRUE(rig().until([] { return rig().now().cameras.watched; })) << "the cameras are free";
  EXPECT_EQ(rig().appliance->state(), State::Staff);
  rig().open(StaffPage::Calibrate);
  EXPECT_TRUE(rig().now().calibration.ended) << rig().now().calibration.problem.detail;
  EXPECT_TRUE(rig().shows("calibration store")) << "nothing of it is lost";
  EXPECT_FALSE(rig().shows("ended")) << "who ended it knows";
  rig().open(StaffPage::Compare);
  ASSERT_EQ(rig().now().put_aside, before + 1) << "the test capture has left its result";
  EXPECT_EQ(rig().now().compared[before].result.name, name);
  // It is shown without a present one, and what is asked of a present one is not.
  EXPECT_FALSE(rig().now().result.there);
  const std::string row = std::to_string(before);
  EXPECT_TRUE(rig().shows("kept picture " + row) && rig().shows("drop " + row));
  EXPECT_TRUE(rig().shows("next stage") && rig().shows("list saved"));
  EXPECT_FALSE(rig().shows("present picture") || rig().shows("keep") || rig().shows("show difference"));
  while (rig().now().stage != TechnicianStage::Mesh) rig().tap("next stage");
  rig().tap("kept picture " + row);
  EXPECT_EQ(rig().screen->draw_list().faces[0].version, rig().now().compared[before].model_number);
  EXPECT_FALSE(rig().shows("show difference"));
  rig().tap("back");
}

// It would be lost: the page would not offer to store it.
TEST_F(TechnicianTest, WhatIsCalibratedWhileTheOneBeforeIsBeingStoredIsNotStoredYet) {
  const auto keeper_is_free = [] { return !rig().side_tasks->busy(JobLane::Keeper); };
  const std::uint32_t own = rig().stages->calibration()->revision;
  rig().open(StaffPage::Calibrate);
  ASSERT_TRUE(rig().until(keeper_is_free));
  const std::size_t count = rig().store->calibrations()->size();
  ASSERT_NO_FATAL_FAILURE(calibrate());
  {
    const BusyLane keeper(*rig().side_tasks, JobLane::Keeper);
    rig().tap("calibration store");
    rig().tap("calibration begin");
    ASSERT_TRUE(rig().until([] { return rig().appliance->state() == State::Calibrate; }));
  }
  ASSERT_TRUE(rig().until(keeper_is_free));
  EXPECT_EQ(rig().store->calibrations()->size(), count + 1) << "the first is";
  ASSERT_TRUE(
      rig().until([] { return rig().now().calibration.views >= 7 || !rig().now().calibration.running; }));
  if (rig().now().calibration.running) rig().tap("calibration finish");
  ASSERT_TRUE(rig().until([] { return rig().now().calibration.ended; }))
      << rig().now().calibration.problem.detail;
  EXPECT_FALSE(rig().now().calibration.stored);
  rig().tap("calibration store");
  ASSERT_TRUE(rig().until([] { return rig().now().calibration.stored; }));
  ASSERT_TRUE(rig().until(keeper_is_free));
  EXPECT_EQ(rig().store->calibrations()->size(), count + 2);
  // Back to the one that fits the test captures.
  ASSERT_TRUE(rig().store->activate_calibration(own).has_value());
  rig().stages->replace(
      *pipeline::Pipeline::make(rig().stages->algorithms(), *rig().store->calibration(own)));
}

}  // namespace
}  // namespace relievo::firmware

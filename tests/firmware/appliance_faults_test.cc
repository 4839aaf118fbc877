// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an appliance makes of cameras, stores and names that fail.
#include "tests/firmware/played_appliance.h"

namespace relievo::firmware {
namespace {

TEST_F(ApplianceTest, AFullDiskLeavesTheModelToBeAcceptedAgain) {
  keep_errors = {Errc::MediaFull};
  ASSERT_TRUE(reach(State::Idle));
  appliance.ask(ui::Intent::Begin);
  ASSERT_TRUE(reach(State::Review));
  appliance.ask(ui::Intent::Accept);
  ASSERT_TRUE(reach(State::Review));
  EXPECT_EQ(appliance.problem()->code, Errc::MediaFull);
  EXPECT_NE(view_of(appliance).model, nullptr);
  appliance.ask(ui::Intent::Accept);
  ASSERT_TRUE(reach(State::Idle));
  EXPECT_EQ(kept, "Ada");
}

TEST_F(ApplianceTest, OnlyAFullDiskIsCalledFull) {
  keep_errors = {Errc::MediaFull, Errc::IoFailed};
  ASSERT_TRUE(reach(State::Idle));
  appliance.ask(ui::Intent::Begin);
  ASSERT_TRUE(reach(State::Review));
  for (const ui::Trouble trouble : {ui::Trouble::StorageFull, ui::Trouble::Storage}) {
    appliance.ask(ui::Intent::Accept);
    ASSERT_TRUE(reach(State::Review));
    EXPECT_EQ(view_of(appliance).trouble, trouble);
  }
}

TEST_F(ApplianceTest, AStoreThatIsBrokenIsAFault) {
  keep_errors = {Errc::StoreCorrupt};
  ASSERT_TRUE(reach(State::Idle));
  appliance.ask(ui::Intent::Begin);
  ASSERT_TRUE(reach(State::Review));
  appliance.ask(ui::Intent::Accept);
  ASSERT_TRUE(reach(State::Fault));
  EXPECT_TRUE(memory_is_wiped());
}

TEST_F(ApplianceTest, APulledCameraIsAFaultAndForgets) {
  ASSERT_TRUE(reach(State::Idle));
  device.right_camera.errors = {Errc::Disconnected};
  appliance.ask(ui::Intent::Begin);
  ASSERT_TRUE(reach(State::Fault));
  EXPECT_EQ(appliance.problem()->code, Errc::Disconnected);
  EXPECT_TRUE(memory_is_wiped());
}

TEST_F(ApplianceTest, ACameraThatMovedIsTheTechniciansBusiness) {
  using pipeline::DriftVerdict;
  const auto enrol = [this] {
    EXPECT_TRUE(reach(State::Idle));
    appliance.ask(ui::Intent::Begin);
    EXPECT_TRUE(reach(State::Review));
    appliance.ask(ui::Intent::Cancel);
  };
  const auto note = [this] { return view_of(appliance).calibration_note.detail; };
  enrol();
  EXPECT_FALSE(appliance.drift()) << "nothing was judged";
  EXPECT_EQ(note(), "");
  stages.drift = {.verdict = DriftVerdict::Warn, .residual_px = 0.31, .expected_px = 0.02};
  enrol();
  EXPECT_EQ(appliance.drift()->verdict, DriftVerdict::Warn);
  EXPECT_NE(note().find("0.31 px"), std::string::npos) << note();
  EXPECT_EQ(note().data(), appliance.calibration_note().data()) << "no copy in every turn";
  EXPECT_FALSE(appliance.problem()) << "the person is not bothered";
  stages.drift->verdict = DriftVerdict::Unknown;  // the next face cannot tell
  enrol();
  EXPECT_NE(note(), "");
  stages.drift->verdict = DriftVerdict::Ok;
  enrol();
  EXPECT_EQ(note(), "");
}

TEST_F(ApplianceTest, ACameraThatMovedTooFarIsAFault) {
  stages.drift = {.verdict = pipeline::DriftVerdict::Refuse, .residual_px = 2.5, .expected_px = 0.02};
  stages.errors = {{State::Match, Errc::NotCalibrated}};
  ASSERT_TRUE(reach(State::Idle));
  appliance.ask(ui::Intent::Begin);
  ASSERT_TRUE(reach(State::Fault));
  EXPECT_EQ(appliance.problem()->code, Errc::NotCalibrated);
  EXPECT_NE(view_of(appliance).calibration_note.detail.find("calibrate again"), std::string::npos);
  EXPECT_TRUE(memory_is_wiped());
  EXPECT_EQ(kept, "");
}

TEST_F(ApplianceTest, ANameThatIsTooLongIsToldAndNothingBegins) {
  ASSERT_TRUE(reach(State::Idle));
  appliance.expect(named(std::string(500, 'x')));
  appliance.ask(ui::Intent::Begin);
  EXPECT_EQ(appliance.state(), State::Idle);
  EXPECT_EQ(appliance.problem()->code, Errc::InvalidInput);
}

TEST(ApplianceSelfTest, ACameraThatDoesNotOpenIsAFault) {
  const test::PlayedWorld world;
  test::PlayedDevice device(world, 4, 4);
  device.left_camera.on_start = Error{Errc::IoFailed, "as the test says"};
  TestStages stages;
  const BootMemory memory(2 * 7 * 16, 1 << 16, 1 << 16);
  ThreadPool pool(1);
  std::string kept;
  std::deque<Errc> errors;
  TestRecords records{kept, errors};
  Appliance appliance({device, stages, memory, pool, records});
  while (appliance.state() == State::SelfTest) appliance.step(milliseconds(1));
  EXPECT_EQ(appliance.state(), State::Fault);
  EXPECT_EQ(appliance.problem()->code, Errc::IoFailed);
}

}  // namespace
}  // namespace relievo::firmware

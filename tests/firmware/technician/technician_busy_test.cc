// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The technician's pages while their threads are busy: what was asked for and has not begun when something
// else is asked for, or when the technician leaves.
#include "tests/firmware/technician/technician_fixture.h"

#include <algorithm>
#include <filesystem>
#include <string>

#include "hal/sim/replay/replay_device.h"
#include "storage/model_blob.h"
#include "tests/firmware/busy_lane.h"

namespace relievo::firmware {
namespace {

// As StaffController does it.
void sign_out(TechnicianRig& rig) {
  rig.appliance->ask(ui::Intent::LeaveStaff);
  rig.side_tasks->cancel();
  rig.turn();
  ASSERT_EQ(rig.appliance->state(), State::Idle);
}

void sign_in(TechnicianRig& rig) {
  rig.appliance->ask(ui::Intent::OpenStaff);
  rig.turn();
  ASSERT_EQ(rig.appliance->state(), State::Staff);
}

TEST_F(TechnicianTest, WhatIsForVisitorsComesIntoUseThoughTheTechnicianLeavesMeanwhile) {
  rig().open(StaffPage::Algorithms);
  rig().tap(kind("matcher"));
  rig().tap(name("zmncc"));
  {
    const BusyLane keeper(*rig().side_tasks, JobLane::Keeper);
    rig().tap("apply");
    sign_out(rig());
  }
  EXPECT_TRUE(rig().until([] { return rig().stages->algorithms().get("matcher") == "zmncc"; }));
  sign_in(rig());
  rig().open(StaffPage::Algorithms);
  EXPECT_EQ(rig().now().choice.kinds[rig().now().choice.kind].value, "zmncc");
  rig().tap("reset");
  rig().tap("apply");
  ASSERT_TRUE(rig().until([] { return rig().stages->algorithms().get("matcher") == "refined"; }));

  // A calibration of before, likewise.
  ASSERT_TRUE(rig().until([] { return !rig().side_tasks->busy(JobLane::Keeper); }));
  for (const char* note : {"once more", "and once more"})
    ASSERT_TRUE(rig().store->save_calibration(*rig().stages->calibration(), note).has_value());
  rig().open(StaffPage::Calibrate);
  ASSERT_TRUE(rig().until([] { return rig().now().calibration.history_count > 1; }));
  const std::uint32_t wanted = rig().now().calibration.history[1].revision;
  rig().revision = 0;
  {
    const BusyLane keeper(*rig().side_tasks, JobLane::Keeper);
    rig().tap("calibration 1");
    sign_out(rig());
  }
  EXPECT_TRUE(rig().until([&] { return rig().revision == wanted; }));
  EXPECT_EQ(rig().stages->calibration()->revision, wanted);
  sign_in(rig());
}

TEST_F(TechnicianTest, WhatIsPutIntoUseIsSaidAlsoWhileARunGoesOn) {
  capture();
  rig().open(StaffPage::Algorithms);
  {
    const BusyLane worker(*rig().side_tasks, JobLane::Worker);
    rig().tap("run");
    rig().tap("apply");
    ASSERT_TRUE(rig().until([] { return rig().now().applied; }));
    rig().turn();
    EXPECT_EQ(rig().now().phase, TechnicianPhase::Running);
    EXPECT_TRUE(rig().shows("run progress"));
    EXPECT_TRUE(rig().shows("applied"));
  }
  ASSERT_TRUE(rig().until(finished));
}

TEST_F(TechnicianTest, WhatWentWrongWithACalibrationIsNotTheNextTechnicians) {
  dynamic_cast<hal::FolderMedia&>(rig().device->media()).unplug();
  rig().open(StaffPage::Calibrate);
  rig().tap("calibration import");
  ASSERT_TRUE(rig().until([] { return !rig().now().calibration.problem.empty(); }));
  sign_out(rig());
  sign_in(rig());
  EXPECT_TRUE(rig().now().calibration.problem.empty());
  rig().plug_in();
}

TEST_F(TechnicianTest, WhatIsSavedIsWhatWasThereWhenItWasAskedFor) {
  capture();
  rig().plug_in();
  {
    const BusyLane worker(*rig().side_tasks, JobLane::Worker);
    rig().tap("save");
    rig().open(StaffPage::Algorithms);
    rig().tap(kind("mesher"));
    rig().tap(name("delaunay"));
    rig().test_capture->act(ui::RunStages{});
    ASSERT_EQ(rig().now().phase, TechnicianPhase::Running);
  }
  ASSERT_TRUE(rig().until([] { return finished() && rig().now().recording.outcome != ui::Outcome::None; }));
  ASSERT_EQ(rig().now().recording.outcome, ui::Outcome::Done);
  const auto making = rig().saved_making();
  ASSERT_TRUE(making);
  EXPECT_EQ(making->set.get("mesher"), "grid");
  EXPECT_EQ(making->records.size(), kStages.size());
  rig().tap("reset");
  rig().plug_in();
}

// What has the worker is somebody else's: it goes on.
TEST_F(TechnicianTest, ARunThatIsStoppedBeforeItsTurnNeverBegins) {
  capture();
  const auto model = [] { return *storage::encode_model(*products().model); };
  const auto before = model();
  BusyLane worker(*rig().side_tasks, JobLane::Worker);
  rig().test_capture->act(ui::RunStages{});
  ASSERT_EQ(rig().now().phase, TechnicianPhase::Running);
  rig().test_capture->act(ui::TechnicianAct::Stop);
  EXPECT_EQ(rig().now().phase, TechnicianPhase::Failed) << "at once";
  worker.go_on();
  ASSERT_TRUE(rig().until([] { return !rig().side_tasks->busy(JobLane::Worker); }));
  EXPECT_FALSE(worker.stopped());
  EXPECT_EQ(model(), before);
  rig().test_capture->act(ui::RunStages{});
  ASSERT_TRUE(rig().until(finished));
  EXPECT_EQ(rig().now().phase, TechnicianPhase::Ready) << rig().now().problem.detail;
  EXPECT_EQ(model(), before);
}

TEST_F(TechnicianTest, ARunThatIsStoppedBeforeItsTurnLeavesWhatIsSavedAsItWas) {
  capture();
  rig().plug_in();
  rig().tap("stage 2");
  rig().tap("by hand");
  rig().tap("left");
  ASSERT_TRUE(rig().now().pairs_changed);
  {
    const BusyLane worker(*rig().side_tasks, JobLane::Worker);
    rig().test_capture->act(ui::RunStages{});
    ASSERT_EQ(rig().now().phase, TechnicianPhase::Running);
    rig().test_capture->act(ui::TechnicianAct::Stop);
  }
  EXPECT_TRUE(rig().now().pairs_changed) << "a pair by hand still waits to be calculated with";
  rig().tap("remove pair");
  rig().tap("save");
  ASSERT_TRUE(rig().until([] { return rig().now().recording.outcome != ui::Outcome::None; }));
  const auto making = rig().saved_making();
  ASSERT_TRUE(making);
  EXPECT_EQ(making->records.size(), kStages.size());
  EXPECT_TRUE(making->by_hand.empty());
  rig().tap("by hand");
  rig().plug_in();
}

TEST_F(TechnicianTest, ASaveThatIsStoppedBeforeItIsOnTheStickIsNotThere) {
  capture();
  rig().plug_in();
  const auto saved = [] { return test::listing(rig().stick()); };
  const std::string before = saved();
  {
    const BusyLane worker(*rig().side_tasks, JobLane::Worker);
    rig().tap("save");
    rig().test_capture->act(ui::TechnicianAct::StopRecording);
  }
  ASSERT_TRUE(rig().until([] { return rig().now().recording.outcome != ui::Outcome::None; }));
  EXPECT_EQ(rig().now().recording.outcome, ui::Outcome::Cancelled);
  EXPECT_EQ(saved(), before);
}

// At a test capture, or at the watch of the page that was open before.
TEST_F(TechnicianTest, TheCamerasAreWatchedAsSoonAsNobodyElseIsAtThem) {
  const auto waits = [] {
    EXPECT_TRUE(rig().says("One moment, please"));
    EXPECT_FALSE(rig().says("It was stopped")) << "nobody did";
    EXPECT_EQ(rig().screen->tree().find("watch")->name, "Stop");
  };
  rig().open(StaffPage::Stages);
  {
    const BusyLane cameras(*rig().side_tasks, JobLane::Capture);
    rig().open(StaffPage::Cameras);
    waits();
  }
  ASSERT_TRUE(rig().until([] { return rig().now().cameras.watched; })) << rig().now().problem.detail;
  rig().open(StaffPage::Stages);
  {
    const BusyLane cameras(*rig().side_tasks, JobLane::Capture);
    rig().open(StaffPage::Cameras);
    ASSERT_TRUE(rig().until([] { return !rig().now().cameras.watched; })) << "the watch before has ended";
    rig().turn();
    waits();
    rig().tap("watch");
    EXPECT_TRUE(rig().says("It was stopped"));
    rig().tap("watch");
    waits();
  }
  ASSERT_TRUE(rig().until([] { return rig().now().cameras.watched; })) << rig().now().problem.detail;
  rig().open(StaffPage::Stages);
  ASSERT_TRUE(rig().until([] { return !rig().side_tasks->busy(JobLane::Capture); }));
}

TEST_F(TechnicianTest, WhatIsLoadedWhileARunGoesOnIsThereAfterIt) {
  capture();
  rig().plug_in();
  rig().tap("save");
  ASSERT_TRUE(rig().until([] { return rig().now().recording.outcome != ui::Outcome::None; }));
  const std::string document = std::filesystem::path(rig().now().recording.where).stem().string();
  rig().plug_in();
  rig().tap("list saved");
  ASSERT_TRUE(rig().until([] { return rig().shows("saved 0"); }));
  const auto& names = rig().now().saved.names;
  const auto row = std::ranges::find_if(names, [&](const auto& one) { return one.starts_with(document); });
  ASSERT_NE(row, names.end());
  {
    const BusyLane worker(*rig().side_tasks, JobLane::Worker);
    {
      const BusyLane keeper(*rig().side_tasks, JobLane::Keeper);
      rig().test_capture->act(ui::LoadSaved{std::size_t(row - names.begin()), true});
      rig().test_capture->act(ui::RunStages{});
      ASSERT_EQ(rig().now().phase, TechnicianPhase::Running);
    }
    ASSERT_TRUE(rig().until([] { return !rig().side_tasks->busy(JobLane::Keeper); }));
  }
  EXPECT_TRUE(rig().until([&] {
    return finished() && rig().now().put_aside == 1 && rig().now().result.name == document;
  })) << "and what there was stands beside it";
  rig().open(StaffPage::Compare);
  rig().tap("drop 0");
}

}  // namespace
}  // namespace relievo::firmware

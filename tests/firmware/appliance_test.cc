// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whole enrolments: from begin to stored, cancelled, tried again.
#include "tests/firmware/played_appliance.h"

namespace relievo::firmware {
namespace {

TEST_F(ApplianceTest, OneEnrolmentFromBeginToStored) {
  ASSERT_TRUE(reach(State::Idle));
  EXPECT_FALSE(appliance.session().is_open());
  appliance.ask(ui::Intent::Begin);
  ASSERT_TRUE(reach(State::Review));
  const ui::ViewState view = view_of(appliance);
  EXPECT_EQ(view.screen, ui::Screen::Review);
  EXPECT_EQ(appliance.session().subject(), "Ada");
  EXPECT_NE(view.model, nullptr);
  EXPECT_EQ(kept, "") << "stored without consent";
  appliance.ask(ui::Intent::Accept);
  ASSERT_TRUE(reach(State::Idle));
  EXPECT_EQ(kept, "Ada");
  EXPECT_EQ(path, "Idle Capture Match Reconstruct Mesh Texture Assemble Review Store Idle ");
  EXPECT_EQ(stages.ran, "MaReMeTeAs");
  EXPECT_EQ(appliance.records().size(), kStages.size());
  EXPECT_FALSE(appliance.problem());
  EXPECT_GT(device.kicks, 0);
  EXPECT_TRUE(memory_is_wiped());
  EXPECT_EQ(view_of(appliance).model, nullptr);
}

TEST_F(ApplianceTest, AfterAFailedStageThePersonTriesAgain) {
  stages.errors = {{State::Match, Errc::NoFace}, {State::Mesh, Errc::PoorGeometry}};
  ASSERT_TRUE(reach(State::Idle));
  appliance.ask(ui::Intent::Begin);
  ASSERT_TRUE(reach(State::Review));
  EXPECT_EQ(
      path,
      "Idle Capture Match Capture Match Reconstruct Mesh Capture Match Reconstruct Mesh Texture Assemble Review ");
  EXPECT_EQ(appliance.attempt(), 3);
}

TEST_F(ApplianceTest, TheMostAttemptsTheStaffCanChooseAreRecordedWithoutMoreMemory) {
  const int most = std::ranges::max(ui::info_of(ui::Setting::Attempts).values);
  EXPECT_GE(appliance.records().capacity(), std::size_t(most) * (kStages.size() + SidePairs::kPoses + 1));
}

TEST_F(ApplianceTest, GivesUpAfterThreeAttemptsAndForgets) {
  stages.errors = {{State::Match, Errc::NoFace}, {State::Match, Errc::NoFace}, {State::Match, Errc::NoFace}};
  ASSERT_TRUE(reach(State::Idle));
  appliance.ask(ui::Intent::Begin);
  ASSERT_TRUE(reach(State::Capture));
  ASSERT_TRUE(reach(State::Idle));
  EXPECT_EQ(appliance.problem()->code, Errc::NoFace);
  EXPECT_TRUE(memory_is_wiped());
  EXPECT_EQ(kept, "");
}

TEST_F(ApplianceTest, CancelStopsTheStageUnderWayAndForgets) {
  for (const State stage : kStages) {
    stages.errors = {{stage, Errc::Cancelled}};
    stages.waiting.store(false);
    ASSERT_TRUE(reach(State::Idle));
    appliance.ask(ui::Intent::Begin);
    while (!stages.waiting.load()) appliance.step(milliseconds(1));
    appliance.ask(ui::Intent::Cancel);
    EXPECT_EQ(appliance.state(), State::Idle) << name_of(stage);
    EXPECT_FALSE(appliance.session().is_open());
    EXPECT_TRUE(memory_is_wiped());
  }
  appliance.ask(ui::Intent::Begin);  // and the next person is served
  EXPECT_TRUE(reach(State::Review));
}

// What was committed has a code, which its person needs: also where the disk takes longer than the state's
// limit, or memory ends meanwhile.
TEST_F(ApplianceTest, WhatIsBeingStoredIsStoredWhateverHappensMeanwhile) {
  for (const bool late : {true, false}) {
    ASSERT_TRUE(reach(State::Idle));
    appliance.forget_kept();
    appliance.ask(ui::Intent::Begin);
    ASSERT_TRUE(reach(State::Review));
    records.held = true;
    records.keeping = false;
    appliance.ask(ui::Intent::Accept);
    while (!records.keeping) appliance.step(milliseconds(1));
    std::thread disk([this] {
      std::this_thread::sleep_for(milliseconds(50));
      records.held = false;
    });
    if (late) {
      world.ahead_s = budget::kStoreLimit / std::chrono::seconds(1) + 1;
      appliance.step(milliseconds(1));
    } else {
      appliance.give_up({Errc::OutOfMemory, "as the test says"});
    }
    disk.join();
    EXPECT_EQ(appliance.state(), State::Idle) << "not Fault";
    EXPECT_EQ(appliance.kept().receipt.view(), "receipt");
    EXPECT_FALSE(appliance.problem());
  }
}

TEST_F(ApplianceTest, CancelAtReviewStoresNothing) {
  ASSERT_TRUE(reach(State::Idle));
  appliance.ask(ui::Intent::Begin);
  ASSERT_TRUE(reach(State::Review));
  appliance.ask(ui::Intent::Cancel);
  EXPECT_EQ(appliance.state(), State::Idle);
  EXPECT_EQ(kept, "");
  EXPECT_TRUE(memory_is_wiped());
}

TEST_F(ApplianceTest, RetakeMakesANewModel) {
  ASSERT_TRUE(reach(State::Idle));
  appliance.ask(ui::Intent::Begin);
  ASSERT_TRUE(reach(State::Review));
  appliance.ask(ui::Intent::Retake);
  EXPECT_EQ(appliance.attempt(), 1);
  ASSERT_TRUE(reach(State::Review));
  EXPECT_EQ(stages.ran, "MaReMeTeAsMaReMeTeAs");
}

TEST_F(ApplianceTest, WhoIsPhotographedStillSeesThemselvesAndNobodyElseDoes) {
  const auto seen = [this] { return view_of(appliance).live.number; };
  ASSERT_TRUE(reach(State::Idle));
  appliance.ask(ui::Intent::Pose);
  ASSERT_EQ(appliance.state(), State::Position);
  for (int turn = 0; turn < 60'000 && seen() == 0; ++turn) appliance.step(milliseconds(1));
  ASSERT_GT(seen(), 0U);
  appliance.ask(ui::Intent::Begin);
  ASSERT_EQ(appliance.state(), State::Capture);
  EXPECT_GT(seen(), 0U) << "until there is another picture";
  ASSERT_TRUE(reach(State::Review));
  appliance.ask(ui::Intent::Retake);
  EXPECT_EQ(seen(), 0U) << "of another try";
  appliance.ask(ui::Intent::Cancel);
  ASSERT_TRUE(reach(State::Idle));
  EXPECT_EQ(appliance.live().newest().number, 0U);
  appliance.ask(ui::Intent::Begin);
  EXPECT_TRUE(appliance.session().is_open());
  EXPECT_EQ(seen(), 0U) << "of the next visitor";
}

TEST_F(ApplianceTest, ATechnicianComesAndGoes) {
  ASSERT_TRUE(reach(State::Idle));
  appliance.ask(ui::Intent::OpenStaff);
  appliance.ask(ui::Intent::Begin);  // not heard here
  EXPECT_EQ(appliance.state(), State::Staff);
  appliance.ask(ui::Intent::Calibrate);
  EXPECT_EQ(appliance.state(), State::Calibrate);
  appliance.end_service_state(true);
  EXPECT_EQ(appliance.state(), State::Staff);
  appliance.ask(ui::Intent::LeaveStaff);
  EXPECT_EQ(appliance.state(), State::Idle);
}

}  // namespace
TEST_F(ApplianceTest, WhatTheRecordsAnsweredIsHeardWhenTheyHave) {
  ASSERT_TRUE(reach(State::Idle));
  records.known = {ui::Known::Code, storage::SubjectId{7}};
  records.held.store(true);
  appliance.ask_records({WipedText("Ada"), WipedText("4821"), true});
  EXPECT_EQ(appliance.answer().known, ui::Known::Asking);
  appliance.step(milliseconds(5));
  EXPECT_EQ(appliance.answer().known, ui::Known::Asking);
  records.held.store(false);
  for (int turn = 0; turn < 60'000 && appliance.answer().known == ui::Known::Asking; ++turn)
    appliance.step(milliseconds(1));
  EXPECT_EQ(appliance.answer().known, ui::Known::Code);
  EXPECT_EQ(appliance.answer().record, storage::SubjectId{7});
  EXPECT_EQ(records.asked, "Ada/4821");
  EXPECT_EQ(appliance.state(), State::Idle);
}

TEST_F(ApplianceTest, TheNextVisitorIsAnsweredThoughTheRecordsAreSlow) {
  ASSERT_TRUE(reach(State::Idle));
  records.known = {ui::Known::Code, storage::SubjectId{7}};
  records.held.store(true);
  appliance.ask_records({WipedText("Ada"), WipedText("4821"), true});
  appliance.forget_answer();
  records.held.store(false);
  appliance.ask_records({WipedText("Bob"), WipedText(), true});
  for (int turn = 0; turn < 60'000 && appliance.answer().known == ui::Known::Asking; ++turn)
    appliance.step(milliseconds(1));
  EXPECT_EQ(appliance.answer().known, ui::Known::Code) << "as these records say to everybody";
  EXPECT_EQ(records.asked, "Bob/");
}

TEST_F(ApplianceTest, AnAnswerThatComesWhenItsVisitorHasGoneIsNobodys) {
  ASSERT_TRUE(reach(State::Idle));
  records.known = {ui::Known::Code, storage::SubjectId{7}};
  records.held.store(true);
  appliance.ask_records({WipedText("Ada"), WipedText("4821"), true});
  appliance.forget_answer();
  records.held.store(false);
  for (int turn = 0; turn < 100; ++turn) appliance.step(milliseconds(1));
  EXPECT_EQ(appliance.answer().known, ui::Known::NotAsked);
  EXPECT_EQ(appliance.answer().record, storage::SubjectId{});
}

// What the keeper is at for the staff may take long to stop, as a stick that does not answer: the main thread
// goes on meanwhile, and the visitor comes next.
TEST_F(ApplianceTest, AQuestionDoesNotHoldTheMainThreadWhileTheKeeperStops) {
  struct Slow final : Job {
    std::atomic<bool> begun{false}, goes{true}, cancelled{false};
    Result<void> run(JobControl& control) override {
      begun = true;
      for (int i = 0; i < 5'000 && goes; ++i) std::this_thread::sleep_for(milliseconds(1));
      cancelled = control.cancelled.load();
      return {};
    }
  } slow;
  ASSERT_TRUE(reach(State::Idle));
  records.known = {ui::Known::Code, storage::SubjectId{7}};
  ASSERT_TRUE(appliance.start_side_job(JobLane::Keeper, slow));
  while (!slow.begun) std::this_thread::sleep_for(milliseconds(1));
  int heard = 0;
  appliance.on_side_report([&](JobLane lane, const std::optional<Error>&) {
    ++heard;
    EXPECT_FALSE(appliance.start_side_job(lane, slow)) << "before the visitor";
  });
  appliance.ask_records({WipedText("Ada"), WipedText("4821"), true});
  appliance.step(milliseconds(5));
  EXPECT_FALSE(slow.cancelled) << "it still runs";
  EXPECT_EQ(appliance.answer().known, ui::Known::Asking);
  slow.goes = false;
  for (int turn = 0; turn < 60'000 && appliance.answer().known == ui::Known::Asking; ++turn)
    appliance.step(milliseconds(1));
  EXPECT_TRUE(slow.cancelled);
  EXPECT_EQ(heard, 1);
  EXPECT_EQ(appliance.answer().known, ui::Known::Code);
}

}  // namespace relievo::firmware

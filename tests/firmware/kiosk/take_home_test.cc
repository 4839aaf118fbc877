// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A visitor's own stick, and what goes wrong with it: each way has an end of its own and a way on, nothing
// half written passes for a copy, and only a stick that came during the visit is written to.
#include "firmware/kiosk/take_home.h"

#include "tests/firmware/busy_lane.h"
#include "tests/firmware/kiosk/take_home_fixture.h"

namespace relievo::firmware {
namespace {

TEST_F(TakeHomeTest, NothingIsOfferedUnlessTheOperatorWantsIt) {
  EXPECT_FALSE(ui::Settings().is_on(ui::Setting::TakeHome)) << "unasked";
  view.settings = {};
  begins_a_visit();
  comes_to_the_end();
  plug(&faulty);
  EXPECT_EQ(taking(), Taking::None);
  EXPECT_EQ(socket.asked, 0) << "nobody even looks for a stick";
  take_home.take(enrolment, view.settings);
  ends();
  EXPECT_EQ(copies(stick_folder()), "");
}

TEST_F(TakeHomeTest, TheirOwnRecordGoesOntoTheirStickAndNothingElse) {
  begins_a_visit();
  plug(&faulty);
  EXPECT_EQ(taking(), Taking::None) << "there is nothing yet to be taken";
  comes_to_the_end();
  ASSERT_EQ(taking(), Taking::Ready);
  EXPECT_EQ(take(), Outcome::Done);
  EXPECT_EQ(taking(), Taking::NoStick) << "it was let go";
  EXPECT_EQ(copies(stick_folder()), code + " ") << "and nobody else's";
  for (const char* file : {"model.ply", "model.glb", "person.record", "manifest.json"})
    EXPECT_TRUE(std::filesystem::exists(stick_folder() / "relievo" / code / file)) << file;
  EXPECT_EQ(test::read_text(stick_folder() / "holiday.txt"), "theirs");
  EXPECT_EQ(logged(), 1);
}

TEST_F(TakeHomeTest, AStickThatWasThereBeforeIsNotWrittenTo) {
  socket.stick = &faulty;
  begins_a_visit();
  comes_to_the_end();
  EXPECT_EQ(taking(), Taking::NotOurs);
  take_home.take(enrolment, view.settings);
  ends();
  EXPECT_EQ(copies(stick_folder()), "");
  plug(nullptr);
  EXPECT_EQ(taking(), Taking::NoStick);
  plug(&faulty);
  EXPECT_EQ(taking(), Taking::Ready) << "a hand has plugged it now";
  // It stays, and the next visitor comes.
  view.receipt = {};
  visited = false;
  begins_a_visit();
  comes_to_the_end();
  EXPECT_EQ(taking(), Taking::NotOurs);
}

TEST_F(TakeHomeTest, AStickThatCameWhileNobodyVisitedIsNotWrittenTo) {
  turn();
  plug(&faulty);
  begins_a_visit();
  comes_to_the_end();
  EXPECT_EQ(taking(), Taking::NotOurs);
  // Nor is the operator's, which was there when they switched it on.
  view.receipt = {};
  visited = false;
  view.settings.set(ui::Setting::TakeHome, 0);
  plug(nullptr);
  plug(&faulty);
  view.settings.set(ui::Setting::TakeHome, 1);
  begins_a_visit();
  comes_to_the_end();
  EXPECT_EQ(taking(), Taking::NotOurs);
}

TEST_F(TakeHomeTest, OfTwoSticksTheOneThatIsInIsWrittenTo) {
  const auto other = folder.path() / "other";
  std::filesystem::create_directory(other);
  FaultyStick second(other);
  begins_a_visit();
  comes_to_the_end();
  plug(&faulty);
  ASSERT_EQ(taking(), Taking::Ready);
  plug(nullptr);
  EXPECT_EQ(taking(), Taking::NoStick);
  take_home.take(enrolment, view.settings);
  turn();
  EXPECT_EQ(taking(), Taking::NoStick) << "there is nothing to write to";
  EXPECT_EQ(view.take_home.outcome, Outcome::None);
  ends_well_on(second, other);
  EXPECT_EQ(copies(stick_folder()), "");
}

TEST_F(TakeHomeTest, AStickThatIsPulledAtTheTouchIsSaidToBeGone) {
  begins_a_visit();
  comes_to_the_end();
  plug(&faulty);
  socket.stick = nullptr;
  EXPECT_EQ(take(), Outcome::StickGone);
  EXPECT_EQ(taking(), Taking::NoStick);
  EXPECT_EQ(logged(), 0);
  ends_well_on(faulty, stick_folder());
}

TEST_F(TakeHomeTest, AStickIsLookedForNowAndThenAndAtOnceWhenItIsWritten) {
  begins_a_visit();
  comes_to_the_end();
  plug(&faulty);
  const int asked = socket.asked;
  for (int i = 0; i < 10; ++i) take_home.follow(view, visited);
  EXPECT_EQ(socket.asked, asked) << "the screen does not wait for it every turn";
  take_home.take(enrolment, view.settings);
  work();
  EXPECT_EQ(view.take_home.outcome, Outcome::Done);
  EXPECT_EQ(taking(), Taking::NoStick) << "who is told that it may be pulled out is not asked to write to it";
}

// The staff's export goes on for a moment after they have left.
TEST_F(TakeHomeTest, AStickThatAnExportLetsGoAndTakesUpAgainIsNoVisitors) {
  socket.stick = &faulty;
  turn();
  BusyLane keeper(side_tasks, JobLane::Keeper);
  begins_a_visit();
  comes_to_the_end();
  EXPECT_EQ(taking(), Taking::NotOurs);
  ASSERT_TRUE(faulty.flush_and_eject());
  turn();
  EXPECT_EQ(taking(), Taking::NoStick);
  ASSERT_TRUE(faulty.take_up_again());
  turn();
  EXPECT_EQ(taking(), Taking::NotOurs);
  keeper.go_on();
  ends();
  EXPECT_EQ(taking(), Taking::NotOurs);
  faulty.plug_in_again();
  ends_well_on(faulty, stick_folder());
}

// Nothing was there before: what comes is the visitor's, whatever else the keeper still does.
TEST_F(TakeHomeTest, AStickThatComesWhileTheKeeperIsBusyIsTheVisitors) {
  BusyLane keeper(side_tasks, JobLane::Keeper);
  begins_a_visit();
  comes_to_the_end();
  EXPECT_EQ(taking(), Taking::NoStick);
  plug(&faulty);
  EXPECT_EQ(taking(), Taking::Ready);
  take_home.take(enrolment, view.settings);
  turn();
  EXPECT_EQ(taking(), Taking::Busy) << "it waits for its turn";
  keeper.go_on();
  ends();
  EXPECT_EQ(view.take_home.outcome, Outcome::Done);
  EXPECT_EQ(copies(stick_folder()), code + " ");
}

// As the log is, once a copy has left.
TEST_F(TakeHomeTest, WhatTheKeeperDoesAfterACopyDoesNotOfferTheStickAgain) {
  begins_a_visit();
  comes_to_the_end();
  plug(&faulty);
  ASSERT_EQ(take(), Outcome::Done);
  plug(nullptr);
  faulty.plug_in_again();
  plug(&faulty);
  ASSERT_EQ(taking(), Taking::Ready);
  BusyLane keeper(side_tasks, JobLane::Keeper);
  plug(nullptr);
  EXPECT_EQ(taking(), Taking::NoStick);
  keeper.go_on();
  ends();
}

// What the keeper does meanwhile is somebody else's: the printing of the code.
TEST_F(TakeHomeTest, WhoStopsBeforeItHasBegunStopsNothingElse) {
  begins_a_visit();
  comes_to_the_end();
  BusyLane keeper(side_tasks, JobLane::Keeper);
  plug(&faulty);
  take_home.take(enrolment, view.settings);
  turn();
  EXPECT_EQ(taking(), Taking::Busy);
  take_home.stop();
  keeper.go_on();
  ends();
  EXPECT_FALSE(keeper.stopped());
  EXPECT_EQ(view.take_home.outcome, Outcome::Cancelled);
  EXPECT_EQ(copies(stick_folder()), "");
  ends_well_on(faulty, stick_folder());
}

TEST_F(TakeHomeTest, WhatGoesWrongIsToldAndCanBeTriedAgain) {
  begins_a_visit();
  comes_to_the_end();
  EXPECT_EQ(taking(), Taking::NoStick);
  fails_with(FaultyStick::Fault::Pulled, Outcome::StickGone);
  fails_with(FaultyStick::Fault::Forgets, Outcome::StickBad);
  fails_with(FaultyStick::Fault::ForgetsLater, Outcome::StickBad);
  fails_with(FaultyStick::Fault::PulledLater, Outcome::StickGone);
  fails_with(FaultyStick::Fault::NotAgain, Outcome::StickUnchecked);
  fails_with(FaultyStick::Fault::Held, Outcome::StickHeld);
}

TEST_F(TakeHomeTest, AFullStickKeepsNothingHalf) {
  test::TinyDisk disk(std::size_t{64} << 10);
  if (!disk.mounted()) GTEST_SKIP() << disk.why_not();
  FaultyStick full(disk.path());
  begins_a_visit();
  comes_to_the_end();
  plug(&full);
  EXPECT_EQ(take(), Outcome::StickFull);
  EXPECT_EQ(copies(disk.path()), "");
  ends_well_on(faulty, stick_folder());
}

TEST_F(TakeHomeTest, AWriteProtectedStickIsNamedSo) {
  test::TinyDisk disk(std::size_t{64} << 20);
  if (!disk.mounted()) GTEST_SKIP() << disk.why_not();
  FaultyStick locked(disk.path());
  ASSERT_TRUE(disk.protect(true));
  begins_a_visit();
  comes_to_the_end();
  plug(&locked);
  EXPECT_EQ(take(), Outcome::StickLocked);
  ASSERT_TRUE(disk.protect(false));
  ends_well_on(locked, disk.path());
}

// A stick that is being flushed answers nobody else until it has been: the page would stand still.
TEST_F(TakeHomeTest, NobodyLooksForAStickWhileTheKeeperHasOne) {
  BusyLane keeper(side_tasks, JobLane::Keeper);
  side_tasks.turn();
  ASSERT_TRUE(side_tasks.busy(JobLane::Keeper));
  const int asked = socket.asked;
  for (int i = 0; i < 5; ++i) turn();
  EXPECT_EQ(socket.asked, asked);
  keeper.go_on();
  work();
  turn();
  EXPECT_GT(socket.asked, asked);
}

}  // namespace
}  // namespace relievo::firmware

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A visitor's own stick, and what goes wrong with it: each way has an end of its own and a way on, nothing
// half written passes for a copy, and only a stick that came during the visit is written to.
#include "firmware/kiosk/take_home.h"

#include "firmware/records/receipt.h"
#include "tests/firmware/played_appliance.h"
#include "tests/storage/sample.h"
#include "tests/support/faulty_stick.h"
#include "tests/support/manual_clock.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

using test::FaultyStick;
using ui::Outcome;
using ui::Taking;

// Where a hand plugs one stick or another.
class Socket final : public hal::RemovableMedia {
 public:
  std::atomic<hal::RemovableMedia*> stick{nullptr};
  std::atomic<int> asked{0};
  std::optional<hal::Medium> current() override {
    ++asked;
    hal::RemovableMedia* in = stick;
    return in != nullptr ? in->current() : std::nullopt;
  }
  Result<void> settle(const std::filesystem::path& folder) override { return stick.load()->settle(folder); }
  Result<void> flush_and_eject() override { return stick.load()->flush_and_eject(); }
  Result<void> take_up_again() override { return stick.load()->take_up_again(); }
};

class TakeHomeTest : public ApplianceTest {
 protected:
  TakeHomeTest() {
    std::filesystem::create_directories(stick_folder());
    test::write_text(stick_folder() / "holiday.txt", "theirs");
    view.settings.set(ui::Setting::TakeHome, 1);
    for (const char* name : {"Grace", "Ada"}) {
      const pipeline::FaceModel model = storage::test::sample_model();
      const auto added =
          store->add_enrolment(storage::NewSubject{name}, storage::test::sample_enrolment(model));
      EXPECT_TRUE(added.has_value());
      enrolment = *added;
    }
    code = receipt_of(*store->subject(store->enrolment(enrolment)->subject));
    EXPECT_TRUE(reach(State::Idle));
  }
  std::filesystem::path stick_folder() const { return folder.path() / "stick"; }
  // Half a second a turn, and as much work as gets done meanwhile.
  void turn() {
    appliance.step(milliseconds(1));
    side_tasks.turn();
    clock.advance(budget::kStickLook);
    view.now = clock.now();
    view.take_home = {};
    take_home.follow(view, visited);
  }
  void begins_a_visit() {
    turn();
    visited = true;
    turn();
  }
  void comes_to_the_end() {
    view.receipt = code;
    turn();
  }
  void plug(hal::RemovableMedia* stick) {
    socket.stick = stick;
    turn();
  }
  Taking taking() const { return view.take_home.taking; }
  // The time in it stands still: what a test waits for is the keeper, not a limit.
  Outcome take() {
    take_home.take(enrolment, view.settings);
    ends();
    return view.take_home.outcome;
  }
  void ends() {
    work();
    turn();
  }
  void work() {
    for (int i = 0; i < 60'000; ++i) {
      appliance.step(milliseconds(1));
      side_tasks.turn();
      view.take_home = {};
      take_home.follow(view, visited);
      if (taking() != Taking::Busy && !side_tasks.busy(JobLane::Keeper)) break;
    }
  }
  std::string copies(const std::filesystem::path& root) const {
    std::string names;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(root / "relievo", none))
      names += entry.path().filename().string() + " ";
    return names;
  }
  int logged() const {
    const auto entries = log.entries();
    return int(std::ranges::count(entries, std::optional(ui::LogEvent::TakenHome), &ui::LogLine::event));
  }
  void ends_well_on(hal::RemovableMedia& stick, const std::filesystem::path& root) {
    plug(nullptr);
    plug(&stick);
    EXPECT_EQ(view.take_home.outcome, Outcome::None) << "what went wrong before is no news";
    ASSERT_EQ(taking(), Taking::Ready);
    const int before = logged();
    EXPECT_EQ(take(), Outcome::Done);
    EXPECT_EQ(copies(root), code + " ");
    EXPECT_EQ(logged(), before + 1) << "the operator can see that a copy left";
  }
  void fails_with(FaultyStick::Fault fault, Outcome outcome) {
    faulty.fail(fault);
    plug(&faulty);
    ASSERT_EQ(taking(), Taking::Ready);
    EXPECT_EQ(take(), outcome) << int(fault);
    faulty.fail(FaultyStick::Fault::None);
    faulty.plug_in_again();
    ends_well_on(faulty, stick_folder());
    plug(nullptr);
    faulty.plug_in_again();
  }

  test::TemporaryFolder folder;
  hal::ManualClock clock;
  std::unique_ptr<storage::Store> store = storage::test::opened(folder.path() / "store");
  FaultyStick faulty{stick_folder()};
  Socket socket;
  EventLog log{clock, {}};
  SideTasks side_tasks{appliance};
  TakeHome take_home{{side_tasks, socket, *store, clock, log}};
  ui::ViewState view;
  bool visited = false;
  storage::EnrolmentId enrolment{};
  std::string code;
};

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

// What the keeper does meanwhile is somebody else's: the printing of the code.
TEST_F(TakeHomeTest, WhoStopsBeforeItHasBegunStopsNothingElse) {
  std::atomic<bool> hold{true}, stopped{false};
  side_tasks.send(
      JobLane::Keeper,
      [&](JobControl& control) -> Result<void> {
        hold.wait(true);
        stopped = control.cancelled.load();
        return {};
      },
      [](const auto&) {}, SideTasks::Whose::Device);
  begins_a_visit();
  comes_to_the_end();
  plug(&faulty);
  take_home.take(enrolment, view.settings);
  turn();
  EXPECT_EQ(taking(), Taking::Busy);
  take_home.stop();
  hold = false;
  hold.notify_all();
  ends();
  EXPECT_FALSE(stopped);
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

class TakeHomeWaitsTest : public TakeHomeTest {
 protected:
  TakeHomeWaitsTest() {
    begins_a_visit();
    comes_to_the_end();
    faulty.fail(FaultyStick::Fault::Waits);
    plug(&faulty);
    take_home.take(enrolment, view.settings);
    for (int i = 0; i < 60'000 && !faulty.waits(); ++i) {
      appliance.step(milliseconds(1));
      side_tasks.turn();
    }
    EXPECT_TRUE(faulty.waits());
    turn();
    EXPECT_EQ(taking(), Taking::Busy);
    EXPECT_GT(view.take_home.progress, 0.5F);
  }
};

TEST_F(TakeHomeWaitsTest, WhoStopsItLeavesNothingHalf) {
  const int asked = socket.asked;
  turn();
  EXPECT_EQ(socket.asked, asked) << "the page does not wait for a stick that is being written";
  take_home.stop();
  turn();
  EXPECT_EQ(taking(), Taking::Busy) << "until it has stopped";
  faulty.let_go_on();
  ends();
  EXPECT_EQ(view.take_home.outcome, Outcome::Cancelled);
  EXPECT_EQ(copies(stick_folder()), "");
  EXPECT_EQ(logged(), 0);
  ends_well_on(faulty, stick_folder());
}

TEST_F(TakeHomeWaitsTest, WhoTouchesTwiceHasOneCopy) {
  take_home.take(enrolment, view.settings);
  faulty.fail(FaultyStick::Fault::None);
  faulty.let_go_on();
  ends();
  EXPECT_EQ(view.take_home.outcome, Outcome::Done);
  EXPECT_EQ(copies(stick_folder()), code + " ");
  EXPECT_EQ(logged(), 1);
}

TEST_F(TakeHomeWaitsTest, AStickThatDoesNotAnswerIsGivenUp) {
  for (auto waited = milliseconds(0); waited <= budget::kTakeHomeLimit; waited += budget::kStickLook) turn();
  EXPECT_EQ(taking(), Taking::NoStick) << "the page waits no longer";
  EXPECT_EQ(view.take_home.outcome, Outcome::Failed);
  const int asked = socket.asked;
  turn();
  EXPECT_EQ(socket.asked, asked) << "nor does the screen hang on it";
  faulty.let_go_on();
  ends();
  EXPECT_EQ(copies(stick_folder()), "");
}

TEST_F(TakeHomeWaitsTest, WhoeverLeavesStopsIt) {
  view.receipt = {};
  visited = false;
  turn();
  EXPECT_EQ(taking(), Taking::None);
  faulty.let_go_on();
  ends();
  EXPECT_EQ(copies(stick_folder()), "");
  begins_a_visit();
  comes_to_the_end();
  EXPECT_EQ(taking(), Taking::NotOurs) << "the next visitor's it is not";
  EXPECT_EQ(view.take_home.outcome, Outcome::None) << "and they are not told of it";
}

TEST_F(TakeHomeWaitsTest, WhoComesBeforeItHasStoppedIsNotOfferedTheStickOfWhoLeft) {
  view.receipt = {};
  visited = false;
  turn();
  visited = true;
  turn();
  faulty.let_go_on();
  ends();
  comes_to_the_end();
  EXPECT_EQ(taking(), Taking::NotOurs);
}

// A stick that is being flushed answers nobody else until it has been: the page would stand still.
TEST_F(TakeHomeTest, NobodyLooksForAStickWhileTheKeeperHasOne) {
  std::atomic<bool> done{false};
  side_tasks.send(
      JobLane::Keeper,
      [&](JobControl&) -> Result<void> {
        while (!done) std::this_thread::sleep_for(milliseconds(1));
        return {};
      },
      [](const std::optional<Error>&) {}, SideTasks::Whose::Device);
  side_tasks.turn();
  ASSERT_TRUE(side_tasks.busy(JobLane::Keeper));
  const int asked = socket.asked;
  for (int i = 0; i < 5; ++i) turn();
  EXPECT_EQ(socket.asked, asked);
  done = true;
  work();
  turn();
  EXPECT_GT(socket.asked, asked);
}

}  // namespace
}  // namespace relievo::firmware

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TakeHomeTest: a visit, a keeper and a socket for sticks, with a record that a visitor may take home.
#pragma once

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <memory>
#include <string>

#include "firmware/kiosk/take_home.h"
#include "firmware/records/receipt.h"
#include "tests/firmware/played_appliance.h"
#include "tests/storage/sample.h"
#include "tests/support/faulty_stick.h"
#include "tests/support/manual_clock.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {

using test::FaultyStick;
using ui::Outcome;
using ui::Taking;

// Where a hand plugs one stick or another.
class Socket final : public hal::RemovableMedia {
 public:
  std::atomic<hal::RemovableMedia*> stick{nullptr};
  std::atomic<int> asked{0};
  std::optional<std::filesystem::path> current() override {
    ++asked;
    hal::RemovableMedia* in = stick;
    return in != nullptr ? in->current() : std::nullopt;
  }
  Result<void> settle(const std::filesystem::path& folder) override { return stick.load()->settle(folder); }
  Result<void> flush_and_eject() override { return stick.load()->flush_and_eject(); }
  Result<void> take_up_again() override { return stick.load()->take_up_again(); }
  bool is_taken_up() override { return stick.load()->is_taken_up(); }
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

}  // namespace relievo::firmware

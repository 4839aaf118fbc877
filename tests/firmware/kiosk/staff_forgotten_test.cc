// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the staff cannot help themselves at the screen: a PIN that was forgotten, a touch screen whose
// correction makes it unusable. `relievo staff` between two lives of the kiosk.
#include "firmware/command/commands.h"
#include "firmware/records/event_log.h"
#include "firmware/service/touch_trial.h"
#include "tests/firmware/kiosk/staff_hands.h"

namespace relievo::firmware {
namespace {

using namespace std::chrono_literals;

class StaffForgottenTest : public StaffHands, public testing::WithParamInterface<bool> {
 protected:
  StaffForgottenTest() { changes.clock = &time; }
  int staff(StaffArgs::Verb verb, bool technician = false) {
    return run_command({StaffArgs{verb, technician, args.store}, 0}, services);
  }
  bool log_says(const char* what) const {
    return text_of_file(args.store / kLogFile).find(what) != std::string::npos;
  }
  void begin_anew() {
    kiosk.reset();
    auto opened = Kiosk::open(args, services);
    ASSERT_TRUE(opened.has_value()) << opened.error().what.view();
    kiosk = std::move(*opened);
    kiosk->ui().resize(1280, 800);
    ASSERT_TRUE(until(
        [this] { return kiosk->ui().visit().step == ui::Step::Attract || kiosk->ui().service().open; }));
    if (!kiosk->ui().service().open) knock();
  }
  // Both lead to the sign-in: before real people the kiosk demands it, elsewhere somebody holds the lock.
  void set_up() {
    changes.live = GetParam();
    begin_anew();
    choose_pins();
  }
  hal::ManualClock time;
};

TEST_P(StaffForgottenTest, OneRoleChoosesItsPinAnewAndTheOthersStays) {
  set_up();
  kiosk.reset();
  ASSERT_EQ(staff(StaffArgs::Verb::ForgetPin), 0);
  EXPECT_TRUE(log_says("The PIN was forgotten: Operator"));
  begin_anew();
  ASSERT_EQ(kiosk->ui().service().page, StaffPage::FirstStart);
  EXPECT_EQ(find("clock right"), nullptr) << "nothing else is asked";
  EXPECT_EQ(find("consent right"), nullptr);
  type_pin("4711");
  EXPECT_EQ(kiosk->view().service->access.fault, ui::PinFault::Taken) << "the technician's is still there";
  type_pin("60915");
  type_pin("60916");
  EXPECT_EQ(kiosk->view().service->access.fault, ui::PinFault::Differ);
  type_pin("60915");
  type_pin("60915");
  ASSERT_TRUE(until([this] { return kiosk->ui().service().page == StaffPage::Pin; }));
  sign_in("60915", StaffRole::Operator);
  sign_out();
  sign_in("4711", StaffRole::Technician);
  sign_out();
  knock();
  type_pin("80526");
  EXPECT_TRUE(kiosk->view().service->access.wrong) << "the old one opens nothing";
  kiosk.reset();
  EXPECT_TRUE(log_says("A new PIN was chosen: Operator"));
}

TEST_P(StaffForgottenTest, ForgettingGivesNobodyFurtherTries) {
  set_up();
  for (const std::chrono::seconds wait : {0s, 2s, 3s, 5s, 9s}) {
    time.advance(wait);
    kiosk->feed({ui::Input::Kind::Down, finger, 1, 1});  // somebody is there
    kiosk->feed({ui::Input::Kind::Up, finger, 1, 1});
    kiosk->turn();
    type_pin("1999");
    ASSERT_TRUE(kiosk->view().service->access.wrong);
    kiosk->turn();
    const bool locked = wait == 9s;
    EXPECT_EQ(says("Too many wrong PINs"), locked) << "one that was mistyped is not too many";
    EXPECT_EQ(says("That was not right."), !locked);
    kiosk->feed({ui::Input::Kind::Back});
    kiosk->turn();
    knock();
    EXPECT_EQ(says("Too many wrong PINs"), locked) << "nor when they come back to the page";
    EXPECT_EQ(says("One moment, please"), !locked);
  }
  ASSERT_GT(kiosk->view().service->access.wait_s, 60);
  kiosk.reset();
  ASSERT_EQ(staff(StaffArgs::Verb::ForgetPin, true), 0);
  begin_anew();
  for (int i = 0; i < 2; ++i) type_pin("2718");
  ASSERT_TRUE(until([this] { return kiosk->ui().service().page == StaffPage::Pin; }));
  EXPECT_GT(kiosk->view().service->access.wait_s, 60) << "the wait goes on";
  time.advance(292s);
  ASSERT_TRUE(until([this] { return !kiosk->ui().service().open; })) << "nobody touches it so long";
  knock();
  ASSERT_GT(kiosk->view().service->access.wait_s, 0);
  ASSERT_LE(kiosk->view().service->access.wait_s, 8);
  EXPECT_TRUE(says("Too many wrong PINs")) << "the end of a long wait is none of a moment";
  time.advance(9s);
  kiosk->feed({ui::Input::Kind::Down, finger, 1, 1});
  kiosk->feed({ui::Input::Kind::Up, finger, 1, 1});
  kiosk->turn();
  sign_in("2718", StaffRole::Technician);
}

INSTANTIATE_TEST_SUITE_P(BeforeRealPeopleAndNot, StaffForgottenTest, testing::Bool());

class StaffCommandTest : public StaffForgottenTest {};

TEST_P(StaffCommandTest, RefusesWhereThereIsNothingToForgetOrSomebodyHasTheStore) {
  EXPECT_NE(staff(StaffArgs::Verb::ForgetPin), 0);
  EXPECT_FALSE(std::filesystem::exists(args.store)) << "a store that is named wrongly is not made";
  set_up();
  EXPECT_NE(staff(StaffArgs::Verb::ForgetPin), 0) << "the kiosk has it";
  kiosk.reset();
  ASSERT_EQ(staff(StaffArgs::Verb::ForgetPin), 0);
  EXPECT_NE(staff(StaffArgs::Verb::ForgetPin), 0) << "it is forgotten already";
}

TEST_P(StaffCommandTest, AScreenWhoseCorrectionIsWrongObeysAgain) {
  set_up();
  kiosk.reset();
  {
    auto store = storage::open_sqlite_store(args.store, wall(), {});
    ASSERT_TRUE(store.has_value());
    const ui::TouchMap upside_down{{-1, 0, 1, 0, -1, 1}};
    ASSERT_TRUE((*store)->set_setting(kTouchSetting, ui::text_of(upside_down)).has_value());
  }
  start();
  tap("start");
  EXPECT_EQ(kiosk->ui().visit().step, ui::Step::Attract) << "the finger is taken for another place";
  kiosk.reset();
  ASSERT_EQ(staff(StaffArgs::Verb::PlainTouch), 0);
  EXPECT_TRUE(log_says("The touch screen is taken as it is."));
  start();
  tap("start");
  EXPECT_EQ(kiosk->ui().visit().step, ui::Step::Consent);
}

INSTANTIATE_TEST_SUITE_P(NotBeforeRealPeople, StaffCommandTest, testing::Values(false));

}  // namespace
}  // namespace relievo::firmware

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A visitor's stick that takes its time: who stops it, touches twice, waits, leaves, or comes next.
#include "firmware/kiosk/take_home.h"

#include "tests/firmware/kiosk/take_home_fixture.h"

namespace relievo::firmware {
namespace {

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

}  // namespace
}  // namespace relievo::firmware

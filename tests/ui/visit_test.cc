// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The way through the screens, without a screen: actions and time go in, intents come out.
#include <cmath>

#include "tests/ui/visit_hands.h"

namespace relievo::ui {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class VisitTest : public VisitHands {};

TEST_F(VisitTest, WhoTurnsTheHeadMaySayThatIsEnough) {
  to_position();
  act(ActionKind::TakePicture);
  machine(Screen::Capture);
  EXPECT_EQ(visit.step, Step::Position) << "nobody is told for a moment that they may move";
  machine(Screen::Turn);
  EXPECT_EQ(visit.step, Step::Turn);
  EXPECT_EQ(pass(kPatience + kLastCall + std::chrono::seconds(1)), std::nullopt)
      << "nobody touches the screen while the head turns";
  EXPECT_EQ(act(ActionKind::EnoughSides), Intent::Enough);
  machine(Screen::Fuse);
  EXPECT_EQ(visit.step, Step::Working);
  machine(Screen::Review);
  EXPECT_EQ(visit.step, Step::Review);
}

TEST_F(VisitTest, WithoutSidesThePictureIsTheLast) {
  to_position();
  ASSERT_TRUE(view.settings.set(Setting::Sides, 0));
  act(ActionKind::TakePicture);
  machine(Screen::Capture);
  EXPECT_EQ(visit.step, Step::Working);
}

TEST_F(VisitTest, NoCameraRunsBeforeConsentAndName) {
  EXPECT_EQ(visit.step, Step::Attract);
  EXPECT_EQ(act(ActionKind::Start), std::nullopt);
  EXPECT_EQ(visit.step, Step::Consent);
  EXPECT_EQ(act(ActionKind::Done), std::nullopt) << "without a name";
  visit.reads_to_the_end();
  EXPECT_EQ(act(ActionKind::Agree), std::nullopt);
  EXPECT_EQ(visit.agreed_at(), view.wall_now);
  EXPECT_EQ(act(ActionKind::Done), std::nullopt) << "without a name";
  visit.type("A");
  EXPECT_EQ(act(ActionKind::Done), Intent::LookUp);
  view.known = Known::Asking;
  EXPECT_EQ(pass(milliseconds(1)), std::nullopt);
  view.known = Known::Nobody;
  EXPECT_EQ(pass(milliseconds(1)), Intent::Pose);
}

TEST_F(VisitTest, WhoSaysNoIsForgotten) {
  act(ActionKind::Start);
  EXPECT_EQ(act(ActionKind::Decline), std::nullopt);
  EXPECT_EQ(visit.step, Step::Declined) << "and is told so";
  pass(kToldFor + seconds(1));
  EXPECT_EQ(visit.step, Step::Attract);
}

TEST_F(VisitTest, NobodyAgreesToWhatTheyHaveNotSeenToItsEnd) {
  act(ActionKind::Start);
  act(ActionKind::Agree);
  EXPECT_EQ(visit.step, Step::Consent);
  visit.reads_to_the_end();
  act(ActionKind::Agree);
  EXPECT_EQ(visit.step, Step::Name);
  act(ActionKind::Leave);
  act(ActionKind::LeaveNow);
  act(ActionKind::Start);
  EXPECT_FALSE(visit.has_read()) << "the next person has read nothing";
}

TEST_F(VisitTest, AFaceInTheOvalIsSomebodyButNotForEver) {
  to_position();
  view.live.advice = pipeline::Advice::OffCentre;
  view.live.nearness = 1;
  int held = 0;
  for (int i = 0; i < 240; ++i) {
    ++view.live.number;
    held += pass(seconds(1)) == Intent::StillHere ? 1 : 0;
    EXPECT_EQ(visit.overlay, Overlay::None);
  }
  EXPECT_GT(held, 200) << "the machine waits, too";
  for (int i = 0; i < 60; ++i) pass(seconds(1));
  EXPECT_EQ(visit.overlay, Overlay::StillThere) << "a picture that stands is nobody";
  ++view.live.number;
  pass(milliseconds(1));
  EXPECT_EQ(visit.overlay, Overlay::StillThere) << "five minutes without a touch are a portrait on a wall";
  visit.touched(view.now);
  EXPECT_EQ(visit.overlay, Overlay::None);
}

TEST_F(VisitTest, WhatStandsAsideAndHasNoFaceIsNobody) {
  to_position();
  view.live.advice = pipeline::Advice::OffCentre;
  view.live.nearness = 0;
  for (int i = 0; i < 60; ++i) {
    ++view.live.number;
    EXPECT_NE(pass(seconds(1)), Intent::StillHere);
  }
  EXPECT_EQ(visit.overlay, Overlay::StillThere);
}

TEST_F(VisitTest, TheCodeStandsUntilItIsTouchedAwayOrLongForgotten) {
  to_review();
  act(ActionKind::Accept);
  machine(Screen::Store);
  machine(Screen::Idle);
  ASSERT_EQ(visit.step, Step::Thanks);
  pass(kReceiptPatience);
  EXPECT_EQ(visit.overlay, Overlay::None);
  pass(seconds(1));
  EXPECT_EQ(visit.overlay, Overlay::StillThere);
  EXPECT_GE(visit.seconds_left(view.now), 19);
  visit.touched(view.now);
  EXPECT_EQ(visit.step, Step::Thanks);
  pass(kReceiptPatience + kLastCall + seconds(1));
  EXPECT_EQ(visit.step, Step::Attract);
}

TEST_F(VisitTest, AWholeVisitTakesFewTouches) {
  to_review();
  EXPECT_EQ(act(ActionKind::Accept), Intent::Accept);
  machine(Screen::Store);
  machine(Screen::Idle);
  EXPECT_EQ(visit.step, Step::Thanks);
  EXPECT_LE(visit.touches, 6);
  act(ActionKind::Finish);
  EXPECT_EQ(visit.step, Step::Attract);
  EXPECT_EQ(visit.name(), "");
}

TEST_F(VisitTest, ThePortraitComesToBeThenTurnsUntilSomebodyTouchesIt) {
  to_review();
  EXPECT_EQ(visit.shown_look(view.now).born, 0);
  float before = 0;
  for (int i = 0; i < 30; ++i) {
    pass(milliseconds(100));
    EXPECT_GE(visit.shown_look(view.now).born, before);
    before = visit.shown_look(view.now).born;
  }
  EXPECT_EQ(before, 1);
  pass(seconds(3));
  const FaceLook turned = visit.shown_look(view.now);
  EXPECT_GT(std::abs(turned.yaw_deg), 5);
  visit.touched(view.now);
  EXPECT_EQ(visit.shown_look(view.now), turned) << "it stays as it stood";
  pass(seconds(3));
  EXPECT_EQ(visit.shown_look(view.now), turned);
  act(ActionKind::LookAtFirst);
  EXPECT_EQ(visit.shown_look(view.now), FaceLook{});
}

// It is open behind.
TEST_F(VisitTest, AFaceWithoutSidesIsSeenFromNoFurtherThanItReaches) {
  for (const bool sides : {false, true}) {
    to_position();
    if (sides) {
      view.live.turn = TurnView{pipeline::TurnAdvice::Hold, 0, 1};
      machine(Screen::Turn);
    }
    machine(Screen::Match);
    view.live.turn.reset();
    machine(Screen::Review);
    visit.turn_face(0, 200, 80);
    EXPECT_FLOAT_EQ(visit.look.pitch_deg, sides ? 50 : 30);
    visit.turn_face(200, 0, 80);
    EXPECT_FLOAT_EQ(visit.look.yaw_deg, sides ? 80 : 60);
    EXPECT_FLOAT_EQ(visit.look.pitch_deg, sides ? 50 : 7.5F) << "the less the further aside";
    for (int i = 0; i < 9; ++i) act(ActionKind::TurnLeft);
    EXPECT_FLOAT_EQ(visit.look.yaw_deg, sides ? -75 : -60);
    act(ActionKind::LeaveNow);
    machine(Screen::Idle);
  }
}

TEST_F(VisitTest, APictureThatWasWantedInTheDarkIsKnownAsOne) {
  to_position();
  view.live.advice = pipeline::Advice::TooDark;
  EXPECT_EQ(act(ActionKind::TakePicture), Intent::Begin) << "it may be the cameras that cannot see them";
  EXPECT_TRUE(visit.shot_in_the_dark);
  machine(Screen::Match);
  machine(Screen::Position);
  view.live.advice = pipeline::Advice::None;
  act(ActionKind::TakePicture);
  EXPECT_FALSE(visit.shot_in_the_dark);
}

TEST_F(VisitTest, NothingMovesByItselfWhereTheStaffWantThat) {
  view.settings.set(Setting::Motion, 0);
  to_review();
  EXPECT_EQ(visit.shown_look(view.now), FaceLook{});
  pass(seconds(5));
  EXPECT_EQ(visit.shown_look(view.now), FaceLook{});
  act(ActionKind::Accept);
  machine(Screen::Store);
  machine(Screen::Idle);
  act(ActionKind::Finish);
  pass(seconds(40));
  const FaceLook invites = visit.shown_look(view.now);
  pass(seconds(3));
  EXPECT_EQ(visit.shown_look(view.now), invites);
}

TEST_F(VisitTest, TheInvitationMovesRestsAndWakesWhenSomebodyComesNear) {
  const auto yaw = [&] { return visit.shown_look(view.now).yaw_deg; };
  pass(seconds(40));
  const float before = yaw();
  pass(seconds(3));
  EXPECT_GT(std::abs(yaw() - before), 5) << "it moves";
  visit.touched(view.now);
  const float read = yaw();
  pass(seconds(3));
  EXPECT_EQ(yaw(), read) << "not while somebody reads";
  view.somebody_near = false;
  pass(seconds(1));
  EXPECT_FALSE(visit.rests(view.now)) << "who looks away for a moment is still there";
  pass(seconds(40));
  EXPECT_TRUE(visit.rests(view.now));
  const float resting = yaw();
  pass(seconds(3));
  EXPECT_EQ(yaw(), resting);
  view.somebody_near = true;
  pass(milliseconds(10));
  EXPECT_FALSE(visit.rests(view.now)) << "at once";
  pass(seconds(4));
  EXPECT_GT(std::abs(yaw() - resting), 5);
}

TEST_F(VisitTest, WhoTriesManyCodesIsSentAway) {
  to_known();
  act(ActionKind::HaveCode);
  EXPECT_EQ(visit.name(), "");
  EXPECT_TRUE(visit.quotes_code());
  visit.type("48219037551271");
  view.known = Known::NoSuchCode;
  int tried = 0;
  for (; visit.step == Step::Name && tried < 50; ++tried) {
    act(ActionKind::Done);
    pass(milliseconds(1));
  }
  EXPECT_EQ(tried, kMostLookUps);
  EXPECT_EQ(visit.step, Step::Attract);
}

TEST_F(VisitTest, NobodyThereIsAskedThenWiped) {
  for (const bool review : {false, true}) {
    if (review) to_review();
    else act(ActionKind::Start);
    EXPECT_EQ(pass(kPatience), std::nullopt);
    EXPECT_EQ(visit.overlay, Overlay::None);
    pass(seconds(1));
    EXPECT_EQ(visit.overlay, Overlay::StillThere);
    EXPECT_EQ(visit.seconds_left(view.now), 19);
    visit.touched(view.now);
    EXPECT_EQ(visit.overlay, Overlay::None) << "a touch is an answer";
    EXPECT_EQ(pass(kPatience + kLastCall + seconds(1)), Intent::Cancel);
    EXPECT_EQ(visit.step, Step::Attract);
    EXPECT_EQ(visit.name(), "");
    machine(Screen::Idle);
    EXPECT_EQ(visit.step, Step::Attract);
  }
}

TEST_F(VisitTest, WhoWaitsForTheirStickIsNotAskedUntilItIsWritten) {
  to_review();
  act(ActionKind::Accept);
  machine(Screen::Store);
  machine(Screen::Idle);
  ASSERT_EQ(visit.step, Step::Thanks);
  EXPECT_EQ(act(ActionKind::TakeHome), Intent::TakeHome);
  view.take_home.taking = Taking::Busy;
  for (int i = 0; i < 10; ++i) pass(kReceiptPatience / 2);
  EXPECT_EQ(visit.overlay, Overlay::None);
  EXPECT_EQ(act(ActionKind::StopTaking), Intent::StopTaking);
  view.take_home.taking = Taking::NoStick;
  pass(milliseconds(300));
  act(ActionKind::Finish);
  EXPECT_EQ(visit.step, Step::Thanks) << "it was meant for what stood there before";
  pass(kReceiptPatience);
  EXPECT_EQ(visit.overlay, Overlay::None) << "the whole time from here on: the code is seen nowhere else";
  pass(seconds(1));
  EXPECT_EQ(visit.overlay, Overlay::StillThere);
  act(ActionKind::Finish);
  EXPECT_EQ(visit.step, Step::Attract);
}

TEST_F(VisitTest, ThePictureIsTakenByItselfWhenAllIsRight) {
  to_position();
  view.live.advice = pipeline::Advice::None;
  view.live.steady_s = kSteadyFor / 2;
  EXPECT_FALSE(visit.countdown(view.live));
  view.live.steady_s = kSteadyFor + 0.5F;
  ASSERT_TRUE(visit.countdown(view.live));
  EXPECT_NEAR(*visit.countdown(view.live), visit.countdown_s() - 0.5F, 1e-5);
  EXPECT_EQ(pass(milliseconds(1)), std::nullopt);
  view.live.steady_s = kSteadyFor + visit.countdown_s();
  EXPECT_EQ(pass(milliseconds(1)), Intent::Begin);
  EXPECT_EQ(pass(milliseconds(1)), std::nullopt) << "once";
}

TEST_F(VisitTest, NoPictureIsTakenWhileSomebodyReads) {
  to_position();
  view.live.advice = pipeline::Advice::None;
  view.live.steady_s = 100;
  for (const ActionKind overlay : {ActionKind::ShowHelp, ActionKind::ShowLanguages, ActionKind::Leave}) {
    act(overlay);
    EXPECT_EQ(pass(milliseconds(1)), std::nullopt);
    act(ActionKind::CloseOverlay);
  }
  EXPECT_EQ(pass(milliseconds(1)), Intent::Begin);
}

TEST_F(VisitTest, ARefusalLeadsBackToThePlaceThenOut) {
  to_position();
  machine(Screen::Match);
  EXPECT_EQ(visit.step, Step::Working);
  view.trouble = Trouble::Refused;
  machine(Screen::Position);
  EXPECT_EQ(visit.step, Step::Position);
  machine(Screen::Match);
  machine(Screen::Idle);
  EXPECT_EQ(visit.step, Step::Trouble);
  pass(kToldFor + seconds(1));
  EXPECT_EQ(visit.step, Step::Attract);
}

TEST_F(VisitTest, AFaultForgetsThePersonAtOnce) {
  to_review();
  visit.language = Language::Arabic;
  view.trouble = Trouble::Camera;
  machine(Screen::Fault);
  EXPECT_EQ(visit.step, Step::Trouble);
  EXPECT_EQ(visit.name(), "");
  EXPECT_EQ(visit.language, Language::Arabic) << "it is told in their language";
  pass(kPatience + seconds(1));
  EXPECT_EQ(visit.step, Step::Trouble);
  EXPECT_EQ(visit.language, Language::English) << "who comes next reads the device's";
  machine(Screen::SelfTest);
  view.trouble = Trouble::None;
  machine(Screen::Idle);
  EXPECT_EQ(visit.step, Step::Attract);
}

TEST_F(VisitTest, LeavingWipesWhatWasTyped) {
  to_position();
  act(ActionKind::Leave);
  EXPECT_EQ(visit.overlay, Overlay::Leave);
  act(ActionKind::Stay);
  EXPECT_EQ(visit.name(), "Z");
  act(ActionKind::Leave);
  EXPECT_EQ(act(ActionKind::LeaveNow), Intent::Cancel);
  EXPECT_EQ(visit.name(), "");
  machine(Screen::Idle);
  EXPECT_EQ(visit.step, Step::Attract);
}

TEST_F(VisitTest, WhoGoesBackToTheFirstPageReadsItAsBefore) {
  act(ActionKind::BiggerText);
  act(ActionKind::ChooseLanguage, static_cast<int>(Language::Arabic));
  act(ActionKind::Start);
  act(ActionKind::Back);
  EXPECT_EQ(visit.step, Step::Attract);
  EXPECT_EQ(visit.language, Language::Arabic);
  EXPECT_EQ(visit.text_percent(), 125);
  pass(kPatience + seconds(1));
  EXPECT_EQ(visit.language, Language::English) << "they have gone";
  EXPECT_EQ(visit.text_percent(), 100);
}

TEST_F(VisitTest, TextGrowsInThreeStepsAndForgetsWithThePerson) {
  act(ActionKind::BiggerText);
  EXPECT_EQ(visit.text_percent(), 125);
  act(ActionKind::BiggerText);
  EXPECT_EQ(visit.text_percent(), 150);
  act(ActionKind::BiggerText, 3);
  EXPECT_EQ(visit.text_percent(), 100) << "where three sizes are all";
  act(ActionKind::BiggerText);
  act(ActionKind::ChooseLanguage, static_cast<int>(Language::Arabic));
  EXPECT_EQ(visit.language, Language::Arabic);
  pass(kPatience + seconds(1));
  EXPECT_EQ(visit.text_percent(), 100);
  EXPECT_EQ(visit.language, Language::English);
}

}  // namespace
}  // namespace relievo::ui

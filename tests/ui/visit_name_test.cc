// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is typed, and what it is typed with.
#include <string>

#include "tests/ui/visit_hands.h"

namespace relievo::ui {
namespace {

using std::chrono::milliseconds;

class VisitNameTest : public VisitHands {};

TEST_F(VisitNameTest, NobodyAgreesByAClockThatWentWrongMeanwhile) {
  act(ActionKind::Start);
  visit.reads_to_the_end();
  view.out_of_order = Trouble::Clock;
  act(ActionKind::Agree);
  pass(milliseconds(1));
  EXPECT_EQ(visit.step, Step::Trouble) << "until it is set";
}

TEST_F(VisitNameTest, ErasingTakesWholeLetters) {
  to_name();
  for (const char* letter : {"J", "ü", "ل", "r"}) visit.type(letter);
  act(ActionKind::Erase);
  EXPECT_EQ(visit.name(), "Jüل");
  act(ActionKind::Erase);
  EXPECT_EQ(visit.name(), "Jü");
  act(ActionKind::Erase);
  EXPECT_EQ(visit.name(), "J");
  act(ActionKind::Erase);
  act(ActionKind::Erase);
  EXPECT_EQ(visit.name(), "");
}

TEST_F(VisitNameTest, ANameHasItsLimitAndNoSpacesAround) {
  to_name();
  visit.type(" ");
  EXPECT_EQ(visit.name(), "");
  for (int i = 0; i < 300; ++i) visit.type("ä");
  EXPECT_EQ(visit.name().size(), kMostNameBytes);
  for (int i = 0; i < 60; ++i) act(ActionKind::Erase);
  visit.type(" ");
  visit.type(" ");
  act(ActionKind::Done);
  EXPECT_NE(visit.name().back(), ' ');
}

TEST_F(VisitNameTest, TheDigitsOfAKeypadTypeLettersAndACodeItsDigits) {
  to_name();
  visit.type_by_digit('2', view.now);
  EXPECT_EQ(visit.name(), "A");
  pass(milliseconds(300));
  visit.type_by_digit('3', view.now);
  visit.type_by_digit('3', view.now);
  EXPECT_EQ(visit.name(), "Ad");
  pass(milliseconds(1500));
  visit.type_by_digit('3', view.now);
  EXPECT_EQ(visit.name(), "Ade") << "after a rest it is another letter";
  for (int i = 0; i < 4; ++i) visit.type_by_digit('3', view.now);
  EXPECT_EQ(visit.name(), "Ade") << "round and round";
  act(ActionKind::Done);
  view.known = Known::Name;
  pass(milliseconds(1));
  act(ActionKind::HaveCode);
  for (const char digit : {'4', '4', '2'}) visit.type_by_digit(digit, view.now);
  EXPECT_EQ(visit.name(), "442");
  visit.type("1-a9");
  EXPECT_EQ(visit.name(), "44219");
  for (int i = 0; i < 20; ++i) visit.type("7");
  EXPECT_EQ(visit.name().size(), kCodeDigits);
}

TEST_F(VisitNameTest, BackFromTheCodeAsksForANameAgain) {
  to_known();
  act(ActionKind::HaveCode);
  visit.type("4821");
  EXPECT_EQ(act(ActionKind::Back), std::nullopt);
  EXPECT_EQ(visit.step, Step::Name);
  EXPECT_FALSE(visit.quotes_code()) << "who touched the wrong button has a way out";
  EXPECT_EQ(visit.name(), "");
  visit.type("B");
  EXPECT_EQ(visit.name(), "B");
  EXPECT_EQ(act(ActionKind::Done), Intent::LookUp);
  view.known = Known::Nobody;
  EXPECT_EQ(pass(milliseconds(1)), Intent::Pose);
  EXPECT_EQ(visit.enrolment_kind(), EnrolmentKind::NewSubject);
}

TEST_F(VisitNameTest, ACodeIsHandedInAsItStands) {
  to_known();
  act(ActionKind::HaveCode);
  visit.type("48219037551271");
  EXPECT_FALSE(visit.code_handed_in());
  act(ActionKind::Done);
  EXPECT_TRUE(visit.code_handed_in());
  visit.type("9");
  EXPECT_TRUE(visit.code_handed_in()) << "it has no room: nothing has changed";
  act(ActionKind::Erase);
  EXPECT_FALSE(visit.code_handed_in());
  visit.type("1");
  act(ActionKind::Done);
  act(ActionKind::Back);
  EXPECT_FALSE(visit.quotes_code());
  visit.type("A");
  act(ActionKind::Done);
  EXPECT_FALSE(visit.code_handed_in()) << "that is a name";
}

TEST_F(VisitNameTest, WhatWasAskedBeforeBackIsNoAnswerAfterIt) {
  to_known();
  act(ActionKind::HaveCode);
  visit.type("48219037551271");
  EXPECT_EQ(act(ActionKind::Done), Intent::LookUp);
  view.known = Known::Asking;
  pass(milliseconds(1));
  act(ActionKind::Back);
  view.known = Known::Code;
  EXPECT_EQ(pass(milliseconds(1)), std::nullopt);
  EXPECT_EQ(visit.step, Step::Name) << "they went back";
  visit.type("B");
  EXPECT_EQ(act(ActionKind::Done), Intent::LookUp);
  for (const Known of_the_code : {Known::Code, Known::NoSuchCode}) {
    view.known = of_the_code;
    EXPECT_EQ(pass(milliseconds(1)), std::nullopt);
    EXPECT_EQ(visit.step, Step::Name);
  }
  view.known = Known::Name;
  pass(milliseconds(1));
  EXPECT_EQ(visit.step, Step::Known) << "that was said of the name";
  act(ActionKind::SomebodyElse);
  EXPECT_EQ(visit.enrolment_kind(), EnrolmentKind::NewSubject);
}

TEST_F(VisitNameTest, ANameThatWasAskedForIsNotAnsweredAfterTheConsentWasReadOnceMore) {
  to_name();
  visit.type("A");
  act(ActionKind::Done);
  view.known = Known::Asking;
  pass(milliseconds(1));
  act(ActionKind::Back);
  act(ActionKind::Agree);
  view.known = Known::Nobody;
  EXPECT_EQ(pass(milliseconds(1)), std::nullopt) << "nobody touched \"Done\" again";
  EXPECT_EQ(visit.step, Step::Name);
}

TEST_F(VisitNameTest, ALetterThatIsRefusedTakesNoneAwayWithTheNext) {
  to_name();
  for (const char* letter : {"A", "n", "n", "a", " "}) visit.type(letter);
  visit.type_by_digit('1', view.now);
  EXPECT_EQ(visit.name(), "Anna ") << "no second blank";
  visit.type_by_digit('1', view.now);
  EXPECT_EQ(visit.name(), "Anna -");
  visit.type_by_digit('1', view.now);
  EXPECT_EQ(visit.name(), "Anna '");
  while (visit.name().size() < kMostNameBytes) visit.type("n");
  const std::string full(visit.name());
  visit.type_by_digit('5', view.now);
  visit.type_by_digit('5', view.now);
  EXPECT_EQ(visit.name(), full);
}

}  // namespace
}  // namespace relievo::ui

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the whole screen says to who listens: how to go on, what a code lacks, and why it falls silent.
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>

#include "tests/support/made_screen.h"
#include "ui/speech/narrator.h"

namespace relievo::ui {
namespace {

constexpr const char* kWrongCode = "No record has this code.";

class HeardTest : public testing::Test {
 protected:
  HeardTest() {
    view.screen = Screen::Idle;
    view.now = hal::Instant(std::chrono::hours(1));
    view.voices.set(std::size_t(Language::English)).set(std::size_t(Language::German));
    view.headphones = true;
    turn();
  }
  // What is said from now on is added to `heard`.
  void turn() {
    ui->frame(view);
    while (const auto intent = ui->take_intent())
      if (*intent != Intent::StillHere) asked = *intent;
    heard += std::string(ui->speak(view, false).text()) + "\n";
  }
  void wait() {
    view.now += kSettled;
    turn();
  }
  void press(Input::Kind kind, std::string_view letter = {}) {
    Input input{kind};
    letter.copy(input.letter.data(), input.letter.size() - 1);
    ui->feed(input, view);
    turn();
  }
  void act(ActionKind kind, int value = 0) {
    ui->visit().touched(view.now);
    (void)ui->visit().act({kind, value}, view);
    turn();
  }
  void to_code() {
    ui->visit().step = Step::Known;
    act(ActionKind::HaveCode);
    view.now += kTooLate;
    turn();
  }
  void type(std::string_view digits) {
    for (const char& digit : digits) press(Input::Kind::Digit, {&digit, 1});
  }
  // As the records do, which need a moment.
  void answer(Known known) {
    for (const Known said : {Known::Asking, known}) {
      view.known = said;
      turn();
    }
    wait();
  }
  bool hears(std::string_view words) const { return heard.find(words) != std::string::npos; }

  std::unique_ptr<Ui> ui = test::make_screen();
  ViewState view;
  std::string heard;
  std::optional<Intent> asked;
};

TEST_F(HeardTest, EveryWrongCodeIsToldAndNoneWhileAnotherIsTyped) {
  to_code();
  type("48219037551271");
  for (const char* next : {"2", "3", "4"}) {
    press(Input::Kind::Activate);
    EXPECT_EQ(asked, Intent::LookUp);
    heard.clear();
    answer(Known::NoSuchCode);
    EXPECT_TRUE(hears(kWrongCode)) << heard;
    EXPECT_NE(ui->tree().find("wrong_code"), nullptr);
    press(Input::Kind::Erase);
    EXPECT_EQ(ui->tree().find("wrong_code"), nullptr) << "that was said of another code";
    press(Input::Kind::Digit, next);
    EXPECT_EQ(ui->tree().find("wrong_code"), nullptr);
  }
}

TEST_F(HeardTest, ACodeSaysHowLongItIsAndWhatItLacks) {
  heard.clear();
  to_code();
  EXPECT_TRUE(hears("0 of 14")) << heard;
  type("4821903755127");
  heard.clear();
  asked.reset();
  press(Input::Kind::Activate);
  EXPECT_TRUE(hears("13 of 14")) << heard;
  EXPECT_EQ(asked, std::nullopt);
  type("1");
  heard.clear();
  type("9");
  EXPECT_TRUE(hears("14 of 14")) << "one too many: " << heard;
  EXPECT_EQ(ui->visit().name(), "48219037551271");
}

TEST_F(HeardTest, HowToGoOnIsSaidInTheLanguageThatIsChosen) {
  EXPECT_TRUE(hears("The arrow keys lead")) << heard;
  heard.clear();
  act(ActionKind::ChooseLanguage, int(Language::German));
  EXPECT_TRUE(hears("Die Pfeiltasten")) << heard;
  heard.clear();
  act(ActionKind::Start);
  EXPECT_FALSE(hears("Die Pfeiltasten")) << "once";
}

// Each with its own button: one after the other they would contradict each other.
TEST_F(HeardTest, WhatAChoiceMeansIsHeardWithItsButton) {
  heard.clear();
  view.known = Known::Code;
  ui->visit().step = Step::Known;
  turn();
  EXPECT_TRUE(hears("What would you like to do?")) << heard;
  EXPECT_FALSE(hears("The old portrait")) << heard;
  for (const auto& [id, words] :
       {std::pair("renew", "Renew it. The old portrait is erased the moment the new one is stored. Button"),
        std::pair("add", "Add another one. The old portrait is kept beside the new one. Button")}) {
    heard.clear();
    for (int i = 0; i < 20 && ui->focus() != id; ++i) press(Input::Kind::Next);
    EXPECT_TRUE(hears(words)) << heard;
  }
}

TEST_F(HeardTest, WhoHandsInNoNameHearsThePageAgain) {
  ui->visit().step = Step::Name;
  turn();
  view.now += kTooLate;
  turn();
  heard.clear();
  press(Input::Kind::Activate);
  EXPECT_TRUE(hears("Your name or your number")) << heard;
  EXPECT_EQ(asked, std::nullopt);
}

// They run while a name is typed, and rest soon after whoever goes back.
TEST_F(HeardTest, WhoGoesBackIsNotToldOfCamerasThatAreAboutToRest) {
  for (const bool rest : {true, false}) {
    ui->visit().step = Step::Name;
    view.cameras_on = true;
    turn();
    heard.clear();
    press(Input::Kind::Back);
    ASSERT_EQ(ui->visit().step, Step::Consent);
    view.now += std::chrono::milliseconds(900);
    turn();
    EXPECT_FALSE(hears("The cameras are on")) << heard;
    view.cameras_on = !rest;
    for (int i = 0; i < 8; ++i) wait();
    EXPECT_EQ(hears("The cameras are off"), rest) << heard;
    for (int i = 0; i < 8; ++i) wait();
    EXPECT_EQ(hears("The cameras are on"), !rest) << "so it is, then: " << heard;
  }
}

TEST_F(HeardTest, ALoudspeakerSaysWhyItIsSilentOnTheStaffsPages) {
  ServiceView staff;
  view.service = &staff;
  view.headphones = false;
  turn();
  act(ActionKind::Speech);
  ASSERT_TRUE(ui->visit().spoken);
  heard.clear();
  ui->service().act({ActionKind::StaffEnter}, view);
  turn();
  EXPECT_EQ(heard, "Only said into headphones\n");
  heard.clear();
  press(Input::Kind::Next);
  wait();
  EXPECT_EQ(heard, "\n\n") << "once, and nothing of the page";
  press(Input::Kind::Back);
  EXPECT_TRUE(hears("Your face in three dimensions")) << heard;
}

}  // namespace
}  // namespace relievo::ui

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/kiosk.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/made_screen.h"
#include "tests/support/manual_clock.h"
#include "tests/support/recording_speaker.h"

namespace relievo::firmware {
namespace {

using namespace std::chrono_literals;

class VoiceTest : public testing::Test {
 protected:
  void SetUp() override {
    screen = test::make_screen();
    auto made = std::make_unique<hal::RecordingSpeaker>(clock, std::vector<std::string>{"en"});
    speaker = made.get();
    voice = std::make_unique<Voice>(std::move(made));
    at(ui::Screen::Idle);
  }
  void at(ui::Screen now) {
    view.screen = now;
    view.now = clock.now();
    voice->look(view);
    screen->frame(view);
    voice->turn(*screen, view);
  }
  // As often as it was heard since the last call.
  long heard(hal::Sound sound) {
    const auto& all = speaker->heard();
    const long count = std::count_if(all.begin() + static_cast<std::ptrdiff_t>(told), all.end(),
                                     [&](const auto& one) { return one.text.empty() && one.sound == sound; });
    told = all.size();
    return count;
  }
  void photograph() {
    for (const auto now : {ui::Screen::Position, ui::Screen::Capture, ui::Screen::Match, ui::Screen::Idle})
      at(now);
  }

  hal::ManualClock clock;
  std::unique_ptr<ui::Ui> screen;
  hal::RecordingSpeaker* speaker = nullptr;
  std::unique_ptr<Voice> voice;
  ui::ViewState view;
  std::size_t told = 0;
};

TEST_F(VoiceTest, SoundsAreForAllUnlessTheStaffWantNone) {
  photograph();
  EXPECT_EQ(heard(hal::Sound::Shutter), 1);
  ASSERT_TRUE(view.settings.set(ui::Setting::Sounds, 0));
  photograph();
  EXPECT_EQ(heard(hal::Sound::Shutter), 0);
  speaker->plug(true);
  photograph();
  EXPECT_EQ(heard(hal::Sound::Shutter), 1) << "to who sees no picture being taken";
}

TEST_F(VoiceTest, TheGuideIsForWhoListensAndNotAtEveryPicture) {
  view.live.advice = pipeline::Advice::OffCentre;
  view.live.number = 1;
  at(ui::Screen::Position);
  for (int i = 0; i < 100; ++i) clock.advance(20ms), at(ui::Screen::Position);
  EXPECT_EQ(heard(hal::Sound::Guide), 0);
  speaker->plug(true);
  for (int i = 0; i < 100; ++i) clock.advance(20ms), at(ui::Screen::Position);
  EXPECT_EQ(heard(hal::Sound::Guide), 4) << "two a second";
}

TEST_F(VoiceTest, AnAdviceIsSaidWithItsSideWhileThePageIsStillBeingRead) {
  speaker->plug(true);
  view.live.advice = pipeline::Advice::NoFace;
  view.live.number = 1;
  at(ui::Screen::Position);
  EXPECT_TRUE(speaker->is_speaking());
  view.live.advice = pipeline::Advice::OffCentre;
  for (const auto& [x, words] :
       {std::pair(0.4F, "Move a little to your right"), std::pair(-0.4F, "Move a little to your left")}) {
    view.live.face_x = x;
    at(ui::Screen::Position);
    clock.advance(x > 0 ? 400ms : 1200ms);  // the page gives way at once, an advice to what stands
    at(ui::Screen::Position);
    const auto& all = speaker->heard();
    const auto last =
        std::find_if(all.rbegin(), all.rend(), [](const auto& one) { return !one.text.empty(); });
    EXPECT_EQ(last->text, words);
    EXPECT_EQ(std::count_if(all.begin(), all.end(), [&](const auto& one) { return one.text == words; }), 1);
  }
}

TEST_F(VoiceTest, WhoTurnsTheHeadIsToldToWhichSide) {
  speaker->plug(true);
  for (const auto& [advice, words] :
       {std::pair(pipeline::TurnAdvice::ToLeft, "Turn your head slowly to your right"),
        std::pair(pipeline::TurnAdvice::ToRight, "Turn your head slowly to your left"),
        std::pair(pipeline::TurnAdvice::Slower, "A little slower, please")}) {
    view.live.turn = ui::TurnView{advice, 0, 0};
    at(ui::Screen::Turn);
    clock.advance(400ms);
    at(ui::Screen::Turn);
    EXPECT_NE(speaker->heard().back().text.find(words), std::string::npos) << speaker->heard().back().text;
  }
}

TEST_F(VoiceTest, WhoTypesACapitalGoesOnFromItsKey) {
  speaker->plug(true);
  at(ui::Screen::Idle);
  for (const auto kind : {ui::ActionKind::Start, ui::ActionKind::Agree}) screen->visit().act({kind, 0}, view);
  at(ui::Screen::Idle);
  const auto press = [&](ui::Input::Kind key) {
    screen->feed({key}, view);
    at(ui::Screen::Idle);
  };
  while (speaker->heard().back().text != "R") press(ui::Input::Kind::Next);
  press(ui::Input::Kind::Activate);
  EXPECT_EQ(screen->visit().name(), "R");
  at(ui::Screen::Idle);
  EXPECT_EQ(speaker->heard().back().text, "R") << "heard as it was typed, and no more";
  press(ui::Input::Kind::Next);
  EXPECT_EQ(speaker->heard().back().text, "t") << "its neighbour, small now";
}

TEST(Voice, WithoutASpeakerIsSilent) {
  ui::ViewState view;
  Voice voice(nullptr);
  voice.look(view);
  EXPECT_TRUE(view.voices.none());
}

}  // namespace
}  // namespace relievo::firmware

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Who is spoken to, in which language, how loud, and for how long.
#include <gtest/gtest.h>

#include <memory>

#include "ui/ui.h"

namespace relievo::ui {
namespace {

using namespace std::chrono_literals;

constexpr auto kGerman = static_cast<std::size_t>(Language::German),
               kHebrew = static_cast<std::size_t>(Language::Hebrew);

class VisitSpeechTest : public testing::Test {
 protected:
  VisitSpeechTest() {
    view.screen = Screen::Idle;
    view.now = hal::Instant{} + 1h;
    view.voices.set(0).set(kGerman);
    follow();
  }
  void follow() { (void)visit.follow(view); }
  void act(ActionKind kind, int value = 0) {
    visit.touched(view.now);
    (void)visit.act({kind, value}, view);
    follow();
  }
  void plug(bool in) {
    view.headphones = in;
    follow();
  }
  ViewState view;
  Visit visit;
};

TEST_F(VisitSpeechTest, HeadphonesTurnItOnAndOff) {
  EXPECT_FALSE(visit.spoken) << "nobody asked";
  plug(true);
  EXPECT_TRUE(visit.spoken);
  act(ActionKind::Speech);
  EXPECT_FALSE(visit.spoken) << "who does not want it";
  act(ActionKind::Speech);
  EXPECT_TRUE(visit.spoken);
  act(ActionKind::Start);
  plug(false);
  EXPECT_FALSE(visit.spoken) << "nothing goes on from a loudspeaker";
  EXPECT_EQ(visit.step, Step::Consent);
}

TEST_F(VisitSpeechTest, WhatWasAskedForEndsWithTheVisit) {
  act(ActionKind::Speech);
  act(ActionKind::Louder);
  act(ActionKind::Speed);
  EXPECT_TRUE(visit.spoken);
  act(ActionKind::Start);
  EXPECT_TRUE(visit.spoken);
  EXPECT_GT(visit.volume, kUsualVolume);
  EXPECT_NE(visit.speed, kUsualSpeed);
  act(ActionKind::LeaveNow);
  EXPECT_FALSE(visit.spoken);
  EXPECT_EQ(visit.volume, kUsualVolume) << "the next visitor is not startled";
  EXPECT_EQ(visit.speed, kUsualSpeed);
  // On the page that invites nobody leaves: it ends when nobody has touched anything for a while.
  act(ActionKind::Speech);
  view.now += 10min;
  follow();
  EXPECT_FALSE(visit.spoken);
  plug(true);
  view.now += 10min;
  follow();
  EXPECT_TRUE(visit.spoken) << "the headphones are still there";
}

TEST_F(VisitSpeechTest, VolumeAndSpeedHaveEnds) {
  for (int i = 0; i < 20; ++i) act(ActionKind::Louder);
  EXPECT_EQ(kVolumePercents[visit.volume], 100);
  for (int i = 0; i < 20; ++i) act(ActionKind::Quieter);
  EXPECT_EQ(visit.volume, 0U);
  for (std::size_t i = 0; i < kSpeedPercents.size(); ++i) act(ActionKind::Speed);
  EXPECT_EQ(visit.speed, kUsualSpeed) << "round and round";
}

TEST_F(VisitSpeechTest, WhoListensIsOfferedWhatCanBeHeard) {
  act(ActionKind::ChooseLanguage, static_cast<int>(kHebrew));
  EXPECT_EQ(visit.language, Language::Hebrew);
  EXPECT_EQ(visit.offered(view).count(), kLanguages);
  plug(true);
  EXPECT_EQ(visit.language, Language::English) << "it has no voice in Hebrew";
  EXPECT_EQ(visit.offered(view).count(), 2U);
  act(ActionKind::ChooseLanguage, static_cast<int>(kHebrew));
  EXPECT_EQ(visit.language, Language::English);
  act(ActionKind::ChooseLanguage, static_cast<int>(kGerman));
  EXPECT_EQ(visit.language, Language::German);
}

TEST_F(VisitSpeechTest, WhereTheUsualLanguageHasNoVoiceAnotherOneSpeaks) {
  view.home = Language::Hebrew;
  follow();
  EXPECT_EQ(visit.language, Language::Hebrew);
  view.voices.reset().set(kGerman);
  plug(true);
  EXPECT_EQ(visit.language, Language::German);
  act(ActionKind::LeaveNow);
  EXPECT_EQ(visit.language, Language::German);
  plug(false);
  act(ActionKind::Start);
  act(ActionKind::LeaveNow);
  EXPECT_EQ(visit.language, Language::Hebrew);
}

TEST_F(VisitSpeechTest, WithoutAVoiceForTheConsentNobodyIsSpokenTo) {
  view.languages.reset().set(kHebrew);
  plug(true);
  act(ActionKind::Speech);
  EXPECT_FALSE(visit.spoken);
  EXPECT_EQ(visit.language, Language::Hebrew);
}

TEST_F(VisitSpeechTest, WhoListensIsThere) {
  act(ActionKind::Start);
  visit.touched(view.now);
  for (int i = 0; i < 10; ++i) {
    view.now += 20s;
    visit.listens(view.now);
    follow();
  }
  EXPECT_EQ(visit.overlay, Overlay::None);
  view.now += std::chrono::seconds(view.settings.of(Setting::PatienceS)) + 1s;
  follow();
  EXPECT_EQ(visit.overlay, Overlay::StillThere);
  visit.listens(view.now);
  view.now += kLastCall;
  follow();
  EXPECT_EQ(visit.step, Step::Attract) << "the question is no answer to itself";
}

}  // namespace
}  // namespace relievo::ui

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/speech/narrator.h"

#include <gtest/gtest.h>

#include <string>

namespace relievo::ui {
namespace {

using namespace std::chrono_literals;

struct Shown {
  std::string heading = "Stand here";
  std::string advice = "Too far";
  std::string progress;
  std::string typed;
  std::string button_value;
  bool help = false;
  bool insists = false, waits = false;
};

class NarratorTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { ASSERT_TRUE(prepare_languages().has_value()); }

  static Node node(Role role, std::string_view id, std::string_view name, std::string_view text = {}) {
    Node made;
    made.role = role;
    made.id = id;
    made.name = name;
    made.text = text;
    return made;
  }
  void make() {
    tree.begin(false);
    tree.open(node(Role::Group, "screen", {}));
    tree.leaf(node(Role::Heading, "title", {}, shown.heading));
    if (!shown.advice.empty()) {
      Node advice = node(Role::Alert, "advice", shown.advice);
      advice.insists = shown.insists, advice.waits = shown.waits;
      tree.open(advice);
      tree.leaf(node(Role::Text, {}, {}, "what is drawn of it"));
      tree.close();
    }
    if (!shown.progress.empty()) {
      Node gauge = node(Role::Status, "progress", "How far it is");
      gauge.value = shown.progress;
      tree.leaf(gauge);
    }
    Node field = node(Role::Field, "name", "Your name");
    field.value = shown.typed;
    field.secret = true;
    tree.open(field);
    tree.leaf(node(Role::Text, "typed", {}, shown.typed));
    tree.close();
    Node button = node(Role::Button, "go", "Go on");
    button.value = shown.button_value;
    button.action = {ActionKind::Done, 0};
    tree.open(button);
    tree.leaf(node(Role::Icon, {}, {}, "\uf054"));
    tree.leaf(node(Role::Text, {}, {}, "Go on"));
    tree.close();
    Node key = node(Role::Key, "key k", {}, "k");
    key.action = {ActionKind::TypeKey, 0};
    tree.leaf(key);
    Node language = node(Role::Button, "de", {}, "Deutsch");
    language.style.language = "de";
    tree.leaf(language);
    if (shown.help) {
      Node veil = node(Role::Group, "veil", {});
      veil.modal = true;
      tree.open(veil);
      tree.leaf(node(Role::Heading, "overlay_title", {}, "Help"));
      tree.leaf(node(Role::Text, "words", {}, "Ask the\u00a0sta\u00adff"));
      tree.close();
    }
    tree.close();
  }
  // What is said of what is shown now.
  std::string hear() {
    make();
    moment.page = shown.help ? 2 : 1;
    return std::string(narrator.follow(tree, moment, to).text());
  }
  std::string hear_later() {
    hear();
    moment.now += kSettled;
    return hear();
  }

  Shown shown;
  Tree tree;
  Narrator narrator;
  Narrator::Moment moment{.now = hal::Instant{} + 1h};
  Listener to{.alone = true};
};

TEST_F(NarratorTest, ReadsAPageOnceAndNotItsButtons) {
  shown.progress = "1 of 4";
  EXPECT_EQ(hear(), "Stand here. Too far. How far it is. 1 of 4. Your name");
  for (int i = 0; i < 100; ++i) {
    moment.now += 1s;
    EXPECT_EQ(hear(), "") << "nothing is repeated without cause";
  }
  shown.heading = "Stored";
  EXPECT_EQ(hear(), "Stored. Too far. How far it is. 1 of 4. Your name");
  narrator.read_again("Hello!");
  EXPECT_EQ(hear(), "Hello! Stored. Too far. How far it is. 1 of 4. Your name");
  narrator.forget();
  EXPECT_EQ(hear(), "Stored. Too far. How far it is. 1 of 4. Your name");
}

TEST_F(NarratorTest, WhatInsistsIsSaidAgainWhileItStandsAndNothingElseIs) {
  shown.insists = true;
  hear();
  moment.now += kAgain - 1ms;
  EXPECT_EQ(hear(), "");
  moment.now += 1ms;
  moment.busy = true;
  EXPECT_EQ(hear(), "") << "nothing is cut short for it";
  moment.busy = false;
  EXPECT_EQ(hear(), "Too far");
  EXPECT_EQ(hear(), "");
  moment.now += kAgain;
  shown.insists = false;
  EXPECT_EQ(hear(), "");
}

TEST_F(NarratorTest, WhatWaitsLeavesTimeToDoWhatWasHeard) {
  shown.waits = true;
  hear();
  moment.busy = true;
  shown.advice = "Too near";
  EXPECT_EQ(hear_later(), "Too near") << "the page may be cut short";
  hear();
  moment.busy = false;
  shown.advice = "Too far";
  EXPECT_EQ(hear_later(), "") << "they are about to move";
  moment.now += kReacts - kSettled;
  EXPECT_EQ(hear(), "Too far");
  moment.busy = true;
  shown.advice = "Too near";
  EXPECT_EQ(hear_later(), "") << "it may be gone when the other is said";
  moment.now += kCutsShort - kSettled;
  EXPECT_EQ(hear(), "Too near");
  shown.waits = false;
  shown.advice = "Very good";
  EXPECT_EQ(hear_later(), "Very good") << "who stands right must not move on";
}

TEST_F(NarratorTest, ReadsWhatLiesOverThePageAlone) {
  hear();
  shown.help = true;
  EXPECT_EQ(hear(), "Help. Ask the staff") << "and nothing that steers the eye";
  shown.advice = "Too near";
  EXPECT_EQ(hear_later(), "");
  shown.help = false;
  EXPECT_EQ(hear(), "Stand here. Too near. Your name");
}

TEST_F(NarratorTest, FollowsTheFocusAndWhatItChanges) {
  hear();
  moment.focus = "go";
  EXPECT_EQ(hear(), "Go on. Button");
  EXPECT_EQ(hear(), "");
  shown.button_value = "on";
  EXPECT_EQ(hear(), "Go on. on. Button") << "pressing it has changed it";
  moment.focus = "de";
  EXPECT_EQ(hear(), "Deutsch");
  EXPECT_EQ(narrator.follow(tree, moment, to).text(), "");
  moment.focus = "go";
  hear();
  moment.focus = "de";
  make();
  EXPECT_EQ(narrator.follow(tree, moment, to).language, "de") << "a language speaks for itself";
  moment.focus = "go";
  hear();
  narrator.read_again();
  EXPECT_EQ(hear(), "Stand here. Too far. Your name");
  EXPECT_EQ(hear(), "") << "the focus, which stayed, does not cut it short";
  moment.focus = {};
  EXPECT_EQ(hear(), "");
}

TEST_F(NarratorTest, AnAlertIsToldOnceItHasStood) {
  hear();
  moment.busy = true;  // an alert does not wait for the rest of the page
  shown.advice = "Too near";
  EXPECT_EQ(hear(), "") << "it may be gone at once";
  shown.advice = "Too far";
  EXPECT_EQ(hear_later(), "") << "it was: and this was said";
  shown.advice = "Too near";
  EXPECT_EQ(hear_later(), "Too near");
  EXPECT_EQ(hear_later(), "");
  shown.advice = "Hold still";
  EXPECT_EQ(hear_later(), "Hold still");
}

TEST_F(NarratorTest, AnAlertThatWentAndCameAgainIsToldAgain) {
  hear();
  shown.advice = {};
  EXPECT_EQ(hear_later(), "");
  shown.advice = "Too far";
  EXPECT_EQ(hear_later(), "Too far") << "it is another mistake, in the same words";
  EXPECT_EQ(hear_later(), "");
}

TEST_F(NarratorTest, AStatusWaitsForQuietAndTheNewestCounts) {
  shown.progress = "1 of 4";
  hear();
  moment.busy = true;
  shown.progress = "2 of 4";
  EXPECT_EQ(hear_later(), "");
  shown.progress = "3 of 4";
  EXPECT_EQ(hear_later(), "");
  moment.busy = false;
  EXPECT_EQ(hear(), "How far it is. 3 of 4");
  EXPECT_EQ(hear(), "");
}

TEST_F(NarratorTest, WhatIsTypedIsToldLetterByLetterToHeadphones) {
  hear();
  shown.typed = "K";
  EXPECT_EQ(hear(), "K");
  shown.typed = "Kö";
  EXPECT_EQ(hear(), "ö");
  shown.typed = "K";
  EXPECT_EQ(hear(), "Erased");
  shown.typed = "Köhler";
  EXPECT_EQ(hear(), "Köhler") << "a code that was shown to the cameras";
  narrator.read_again();
  EXPECT_EQ(hear(), "Stand here. Too far. Your name. Köhler");
  moment.focus = "key k";
  EXPECT_EQ(hear(), "k");
  moment.focus = "go";
  shown.typed = "Köhlerk";
  EXPECT_EQ(hear(), "k") << "not the key that the letter has changed";
  EXPECT_EQ(hear(), "");
}

TEST_F(NarratorTest, NothingOfItIsToldToALoudspeaker) {
  to.alone = false;
  EXPECT_EQ(hear(), "Stand here. Too far. Your name");
  shown.typed = "K";
  EXPECT_EQ(hear(), "Typed");
  shown.typed = "";
  EXPECT_EQ(hear(), "Erased");
  shown.typed = "Köhler";
  EXPECT_EQ(hear(), "Typed");
  narrator.read_again();
  EXPECT_EQ(hear(), "Stand here. Too far. Your name. Only said into headphones");
  moment.focus = "key k";
  EXPECT_EQ(hear(), "Only said into headphones");
}

TEST_F(NarratorTest, SpeaksTheLanguageOfThePage) {
  to.tr = Words(Language::German);
  hear();
  moment.focus = "go";
  EXPECT_EQ(hear(), "Go on. Schaltfläche");
  make();
  narrator.read_again();
  EXPECT_EQ(narrator.follow(tree, moment, to).language, "de");
}

// No words stay behind, of many statuses neither.
TEST_F(NarratorTest, KeepsNoTexts) {
  tree.begin(false);
  tree.open(node(Role::Group, "screen", {}));
  for (int i = 0; i < 40; ++i)
    tree.leaf(node(Role::Status, tree.keep("status " + std::to_string(i)), "Ada Lovelace"));
  tree.close();
  EXPECT_EQ(narrator.follow(tree, moment, to).text(), "Ada Lovelace");
  EXPECT_EQ(narrator.follow(tree, moment, to).text(), "");
  const std::string_view kept(reinterpret_cast<const char*>(&narrator), sizeof narrator);
  EXPECT_EQ(kept.find("Lovelace"), std::string_view::npos);
}

TEST_F(NarratorTest, WhatDoesNotFitIsNotSaid) {
  shown.heading = std::string(30'000, 'a');
  const std::string said = hear();
  EXPECT_LT(said.size(), 30'000U);
  EXPECT_GT(said.size(), 20'000U);
  narrator.forget();
  shown.heading = "Stand here";
  EXPECT_EQ(hear(), "Stand here. Too far. Your name");
}

}  // namespace
}  // namespace relievo::ui

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every screen in every language, as it is heard: there are words for all that is seen and touched, and a
// loudspeaker does not get those that are a person's own.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "firmware/demo/gallery.h"
#include "tests/ui/languages.h"
#include "ui/screens/staff_screens.h"
#include "ui/screens/visitor/visitor_screens.h"
#include "ui/speech/narrator.h"

namespace relievo::firmware {
namespace {

constexpr ui::Rect kScreen{0, 0, 1280, 800};

// The icon font's letters: U+F000 to U+F8FF.
bool has_icon(std::string_view text) {
  for (std::size_t at = text.find('\xef'); at != std::string_view::npos; at = text.find('\xef', at + 1)) {
    if (at + 1 < text.size() && static_cast<unsigned char>(text[at + 1]) <= 0xA3) return true;
  }
  return false;
}

class GallerySpeechTest : public testing::TestWithParam<ui::Language> {
 protected:
  static void SetUpTestSuite() { ASSERT_TRUE(ui::prepare_languages().has_value()); }

  void build(const Exhibit& exhibit) {
    if (exhibit.service.open) build_staff_screen(tree, exhibit.view, exhibit.visit, exhibit.service, kScreen);
    else build_visitor_screen(tree, exhibit.view, exhibit.visit, kScreen);
  }
  std::string page(bool alone) {
    said.clear();
    ui::say_page(tree, {ui::Words(GetParam()), alone}, said);
    return std::string(said.text());
  }
  std::string focus(const ui::Node& node, bool alone) {
    said.clear();
    ui::say_focus(tree, node, {ui::Words(GetParam()), alone}, said);
    return std::string(said.text());
  }

  // By id, what a finger presses says to headphones.
  std::map<std::string, std::string> words_of_buttons() {
    std::map<std::string, std::string> all;
    for (const ui::Node& node : tree.nodes())
      if (node.role == ui::Role::Button) all.emplace(node.id, focus(node, true));
    return all;
  }

  // Without the rests between digits that are spoken one by one.
  static std::string bare(std::string text) {
    std::erase_if(text, [](char c) { return c == ' ' || c == ','; });
    return text;
  }

  ui::Tree tree;
  ui::Utterance said;
};

TEST_P(GallerySpeechTest, EveryPageAndEveryButtonHasWords) {
  for (const Exhibit& exhibit : gallery({}, GetParam(), 0, false)) {
    SCOPED_TRACE(exhibit.name);
    build(exhibit);
    const std::string words = page(true);
    EXPECT_FALSE(words.empty());
    EXPECT_FALSE(has_icon(words)) << words;
    const ui::Node* heading = tree.find(tree.find("overlay_title") != nullptr ? "overlay_title" : "title");
    if (heading != nullptr) {
      ui::Utterance title;
      title.say(heading->text);
      EXPECT_NE(words.find(title.text()), std::string::npos) << words << " lacks " << title.text();
    }
    for (const ui::Node& node : tree.nodes()) {
      if (node.action.kind == ui::ActionKind::None) continue;
      const std::string button = focus(node, true);
      EXPECT_FALSE(button.empty()) << node.id << " says nothing";
      EXPECT_FALSE(has_icon(button)) << button;
    }
  }
}

// What two buttons of a page do is told apart in this language as in English.
TEST_P(GallerySpeechTest, ButtonsThatDifferInEnglishDifferHere) {
  const auto here = gallery({}, GetParam(), 0, false), english = gallery({}, ui::Language::English, 0, false);
  ASSERT_EQ(here.size(), english.size());
  for (std::size_t i = 0; i < here.size(); ++i) {
    SCOPED_TRACE(here[i].name);
    build(english[i]);
    const auto in_english = words_of_buttons();
    build(here[i]);
    std::map<std::string, std::string> meant;  // by what is heard
    for (const auto& [id, words] : words_of_buttons()) {
      const auto same = in_english.find(id);
      if (same == in_english.end()) continue;
      EXPECT_EQ(meant.emplace(words, same->second).first->second, same->second) << words;
    }
  }
}

// Six times "less" and "more", each of something else.
TEST_P(GallerySpeechTest, TheButtonsOfTheClockSayWhatTheyMove) {
  const auto all = gallery({}, GetParam(), 0, false);
  const auto clock = std::ranges::find(all, "staff_first_clock", &Exhibit::name);
  ASSERT_NE(clock, all.end());
  build(*clock);
  std::set<std::string> heard;
  for (const auto& [id, words] : words_of_buttons()) EXPECT_TRUE(heard.insert(words).second) << words;
  EXPECT_GT(heard.size(), 12U);
}

TEST_P(GallerySpeechTest, ALoudspeakerIsToldNothingPrivate) {
  std::size_t codes = 0, names = 0, keys = 0;
  for (const Exhibit& exhibit : gallery({}, GetParam(), 0, false)) {
    if (exhibit.service.open) continue;  // the staff hear their side in headphones alone
    SCOPED_TRACE(exhibit.name);
    build(exhibit);
    const std::string aloud = page(false), alone = page(true);
    if (exhibit.name == "thanks") {
      constexpr const char* kSpelled = "4 8 2 1 , 9 0 3 7 , 5 5 1 2 , 7 1";
      EXPECT_NE(alone.find(kSpelled), std::string::npos) << alone;
      for (const char* part : {"4821", kSpelled, "9 0 3 7"}) EXPECT_EQ(aloud.find(part), std::string::npos);
      ++codes;
    }
    if (const std::string_view typed = exhibit.visit.name(); !typed.empty()) {
      EXPECT_NE(bare(alone).find(bare(std::string(typed))), std::string::npos) << alone;
      EXPECT_EQ(aloud.find(typed), std::string::npos) << aloud;
      ++names;
    }
    std::string key_said;
    for (const ui::Node& node : tree.nodes()) {
      if (node.action.kind != ui::ActionKind::TypeKey) continue;
      const std::string said_aloud = focus(node, false);
      EXPECT_TRUE(key_said.empty() || said_aloud == key_said) << "keys cannot be told apart by a bystander";
      key_said = said_aloud;
      EXPECT_NE(focus(node, true), said_aloud);
      ++keys;
    }
  }
  EXPECT_EQ(codes, 1U);
  EXPECT_GE(names, 2U);
  EXPECT_GT(keys, 90U);
}

INSTANTIATE_TEST_SUITE_P(Languages, GallerySpeechTest, ui::kEveryLanguage, ui::language_code);

}  // namespace
}  // namespace relievo::firmware

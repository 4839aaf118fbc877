// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every word on a screen exists in every language.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "ui/language/language.h"

namespace relievo::ui {
namespace {

// The literals that are handed to tr(...) and to the first place of tr.plural(...).
void collect(const std::string& source, std::set<std::string>& texts) {
  for (const std::string call : {"tr(\"", "tr.plural(\""}) {
    for (std::size_t at = source.find(call); at != std::string::npos; at = source.find(call, at + 1)) {
      std::string text;
      for (std::size_t i = at + call.size(); i < source.size() && source[i] != '"'; ++i) {
        if (source[i] == '\\') ++i;
        text += source[i];
      }
      texts.insert(text);
    }
  }
}

std::set<std::string> texts_in_the_screens() {
  std::set<std::string> texts;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(std::filesystem::path(RELIEVO_SOURCE_DIR) / "ui" / "screens")) {
    if (entry.path().extension() != ".cc") continue;
    std::ifstream in(entry.path());
    collect({(std::istreambuf_iterator<char>(in)), {}}, texts);
  }
  return texts;
}

std::size_t holes(const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find("{}"); at != std::string::npos; at = text.find("{}", at + 2)) ++count;
  return count;
}

class WordsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { ASSERT_TRUE(prepare_languages().has_value()); }
};

TEST_F(WordsTest, EveryTextOfEveryScreenIsTranslated) {
  const auto texts = texts_in_the_screens();
  ASSERT_GT(texts.size(), 80U) << "the screens' sources were not found";
  for (const Language language : {Language::German, Language::Arabic}) {
    const Words words(language);
    for (const std::string& text : texts) {
      const std::string said = text.find("{} second") != std::string::npos ? words.plural(text.c_str(), "", 5) : words(text.c_str());
      EXPECT_NE(said, text) << info_of(language).code;
      EXPECT_EQ(holes(said), holes(text)) << said;
    }
  }
}

TEST_F(WordsTest, WhatNobodyTranslatedIsNoticed) {
  EXPECT_FALSE(Words(Language::German).knows("This text is in no catalogue"));
  EXPECT_TRUE(Words(Language::German).knows("Back"));
}

TEST_F(WordsTest, ArabicHasItsSixForms) {
  const Words words(Language::Arabic);
  std::set<std::string> forms;
  for (const unsigned long n : {0UL, 1UL, 2UL, 5UL}) forms.insert(words.plural("In {} second everything is wiped.", "In {} seconds everything is wiped.", n));
  EXPECT_EQ(forms.size(), 4U);
  EXPECT_EQ(words.plural("In {} second everything is wiped.", "In {} seconds everything is wiped.", 103),
            std::string(words.plural("In {} second everything is wiped.", "In {} seconds everything is wiped.", 3)));
}

TEST_F(WordsTest, LanguagesChangeFromOneWordToTheNext) {
  EXPECT_STREQ(Words(Language::English)("Back"), "Back");
  EXPECT_STREQ(Words(Language::German)("Back"), "Zurück");
  EXPECT_STREQ(Words(Language::English)("Back"), "Back");
}

}  // namespace
}  // namespace relievo::ui

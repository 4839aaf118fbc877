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

// Of the staff's pages (screens/service/), or of all others.
std::set<std::string> texts_in_the_screens(bool of_the_staff) {
  std::set<std::string> texts;
  const std::filesystem::path screens = std::filesystem::path(RELIEVO_SOURCE_DIR) / "ui" / "screens";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(screens)) {
    const bool staff = *entry.path().lexically_relative(screens).begin() == "service";
    if (entry.path().extension() != ".cc" || staff != of_the_staff) continue;
    std::ifstream in(entry.path());
    collect({(std::istreambuf_iterator<char>(in)), {}}, texts);
  }
  return texts;
}

std::size_t count(const std::string& text, const std::string& sought) {
  std::size_t found = 0;
  for (std::size_t at = text.find(sought); at != std::string::npos; at = text.find(sought, at + sought.size())) ++found;
  return found;
}

std::size_t holes(const std::string& text) { return count(text, "{}"); }

bool ends_with(const std::string& text, const std::string& end) { return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0; }

// What a catalogue says, its header left out.
std::vector<std::string> translations(const std::string& code) {
  std::ifstream in(std::filesystem::path(RELIEVO_SOURCE_DIR) / "ui" / "language" / (code + ".po"));
  std::vector<std::string> all;
  for (std::string line; std::getline(in, line);) {
    const std::size_t quote = line.find('"');
    if (line.rfind("msgstr", 0) == 0 && line.size() > quote + 2) all.push_back(line.substr(quote + 1, line.size() - quote - 2));
  }
  EXPECT_GT(all.size(), 500U) << code << ".po was not read";
  return all;
}

class WordsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { ASSERT_TRUE(prepare_languages().has_value()); }
};

// The same words in two languages are possible ("Code"), English words in Arabic are not: only a text
// that a catalogue lacks is a mistake, and gettext cannot tell; so the catalogue itself is read.
bool has_entry(const std::string& po, const std::string& text) {
  const std::size_t at = po.find("msgid \"" + text + "\"\n");
  if (at == std::string::npos) return false;
  const std::size_t said = po.find("msgstr", at);
  const std::size_t quote = po.find('"', said);
  return quote != std::string::npos && po[quote + 1] != '"';
}

void every_text_is_known(Language language, const std::set<std::string>& texts) {
  const Words words(language);
  const std::string code = std::string(info_of(language).code).substr(0, 2);
  std::ifstream in(std::filesystem::path(RELIEVO_SOURCE_DIR) / "ui" / "language" / (code + ".po"));
  const std::string po{std::istreambuf_iterator<char>(in), {}};
  for (const std::string& text : texts) {
    EXPECT_TRUE(has_entry(po, text)) << code << ".po lacks: " << text;
    const bool counts = text.find("{} second") != std::string::npos;
    const std::string said = counts ? words.plural(text.c_str(), "", 5) : words(text.c_str());
    EXPECT_EQ(holes(said), holes(text)) << said;
  }
}

TEST_F(WordsTest, EveryTextOfAVisitorIsInEveryLanguage) {
  const auto texts = texts_in_the_screens(false);
  ASSERT_GT(texts.size(), 80U) << "the screens' sources were not found";
  for (std::size_t i = 0; i < kLanguages; ++i) {
    if (static_cast<Language>(i) != Language::English) every_text_is_known(static_cast<Language>(i), texts);
  }
}

TEST_F(WordsTest, EveryTextOfTheStaffIsInTheLanguagesTheyAreOffered) {
  const auto texts = texts_in_the_screens(true);
  for (const Language language : kStaffLanguages) {
    if (language != Language::English) every_text_is_known(language, texts);
  }
  for (const Language offered : {Language::German, Language::French, Language::Spanish, Language::Arabic}) EXPECT_EQ(staff_language(offered), offered);
  EXPECT_EQ(staff_language(Language::Japanese), Language::English);
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

TEST_F(WordsTest, NothingIsOneInFrenchAndManyInSpanish) {
  const auto days = [](Language language, unsigned long n) { return std::string(Words(language).plural("{} day", "{} days", n)); };
  EXPECT_EQ(days(Language::French, 0), days(Language::French, 1));
  EXPECT_NE(days(Language::French, 2), days(Language::French, 1));
  EXPECT_EQ(days(Language::Spanish, 0), days(Language::Spanish, 2));
  EXPECT_NE(days(Language::Spanish, 2), days(Language::Spanish, 1));
}

// What stands behind a breakable space, or behind none, in French; what opens and what closes in Spanish.
TEST_F(WordsTest, FrenchAndSpanishPunctuateAsTheirReadersDo) {
  for (const std::string& said : translations("fr")) {
    for (std::size_t at = said.find_first_of(":;?!"); at != std::string::npos; at = said.find_first_of(":;?!", at + 1)) {
      const bool inside_a_name = at + 1 < said.size() && said[at] == ':' && said[at + 1] != ' ';
      EXPECT_TRUE(inside_a_name || ends_with(said.substr(0, at), "\u00a0") || ends_with(said.substr(0, at), "\u202f")) << said;
    }
    EXPECT_EQ(said.find('\''), std::string::npos) << said;
  }
  for (const std::string& said : translations("es")) {
    EXPECT_EQ(count(said, "?"), count(said, "¿")) << said;
    EXPECT_EQ(count(said, "!"), count(said, "¡")) << said;
  }
}

TEST_F(WordsTest, LanguagesChangeFromOneWordToTheNext) {
  EXPECT_STREQ(Words(Language::English)("Back"), "Back");
  EXPECT_STREQ(Words(Language::German)("Back"), "Zurück");
  EXPECT_STREQ(Words(Language::English)("Back"), "Back");
}

}  // namespace
}  // namespace relievo::ui

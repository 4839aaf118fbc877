// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every word on a screen exists in every language.
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ui/language/language.h"

namespace relievo::ui {
namespace {

// The literals that are handed to tr(...), mark_tr(...) and to the first place of tr.plural(...).
void collect(const std::string& source, std::set<std::string>& texts) {
  for (const std::string call : {"tr(", "tr.plural("}) {
    for (std::size_t at = source.find(call); at != std::string::npos; at = source.find(call, at + 1)) {
      std::size_t i = source.find_first_not_of(" \n", at + call.size());
      if (source[i] != '"') continue;
      std::string text;
      for (++i; i < source.size() && source[i] != '"'; ++i) {
        if (source[i] == '\\') ++i;
        text += source[i];
      }
      texts.insert(text);
    }
  }
}

std::set<std::string> texts_of_the_pages() {
  std::set<std::string> texts;
  const std::filesystem::path ui = std::filesystem::path(RELIEVO_SOURCE_DIR) / "ui";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(ui)) {
    if (entry.path().extension() != ".cc") continue;
    std::ifstream in(entry.path());
    collect({(std::istreambuf_iterator<char>(in)), {}}, texts);
  }
  return texts;
}

std::size_t count(const std::string& text, const std::string& sought) {
  std::size_t found = 0;
  for (std::size_t at = text.find(sought); at != std::string::npos;
       at = text.find(sought, at + sought.size()))
    ++found;
  return found;
}

std::size_t holes(const std::string& text) { return count(text, "{}"); }

bool ends_with(const std::string& text, const std::string& end) { return text.ends_with(end); }

// What stands in a catalogue behind "msgid" or "msgstr", its header left out.
std::vector<std::string> entries(const std::string& code, const std::string& keyword) {
  std::ifstream in(std::filesystem::path(RELIEVO_SOURCE_DIR) / "ui" / "language" / (code + ".po"));
  std::vector<std::string> all;
  for (std::string line; std::getline(in, line);) {
    const std::size_t quote = line.find('"');
    if (line.rfind(keyword, 0) == 0 && line.size() > quote + 2)
      all.push_back(line.substr(quote + 1, line.size() - quote - 2));
  }
  EXPECT_GT(all.size(), 400U) << code << ".po has fewer texts than any language, or was not read";
  return all;
}

std::vector<std::string> translations(const std::string& code) { return entries(code, "msgstr"); }

// Whole letters of a text, none of them taken for a part of another.
std::vector<std::string> letters(const std::string& text) {
  std::vector<std::string> all;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U) all.emplace_back();
    all.back() += c;
  }
  return all;
}

bool is_kana(const std::string& letter) { return letter >= "\u3041" && letter <= "\u30fe"; }
bool is_east_asian(const std::string& letter) {
  return is_kana(letter) || (letter >= "\u4e00" && letter <= "\u9fff");
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

std::string code_of(Language language) { return std::string(info_of(language).code).substr(0, 2); }

void every_text_is_known(Language language, const std::set<std::string>& texts) {
  const Words words(language);
  const std::string code = code_of(language);
  std::ifstream in(std::filesystem::path(RELIEVO_SOURCE_DIR) / "ui" / "language" / (code + ".po"));
  const std::string po{std::istreambuf_iterator<char>(in), {}};
  for (const std::string& text : texts) {
    EXPECT_TRUE(has_entry(po, text)) << code << ".po lacks: " << text;
    const bool counts =
        text.find("{} second") != std::string::npos || text.find("{} day") != std::string::npos;
    const std::string said = counts ? words.plural(text.c_str(), "", 5) : words(text.c_str());
    EXPECT_EQ(holes(said), holes(text)) << said;
  }
}

void every_language_knows(const std::set<std::string>& texts) {
  for (std::size_t i = 0; i < kLanguages; ++i)
    if (static_cast<Language>(i) != Language::English) every_text_is_known(static_cast<Language>(i), texts);
}

TEST_F(WordsTest, EveryCatalogueHasWhatThePagesSayAndNothingElse) {
  const auto texts = texts_of_the_pages();
  ASSERT_GT(texts.size(), 400U) << "the pages' sources were not found";
  every_language_knows(texts);
  for (std::size_t i = 0; i < kLanguages; ++i) {
    if (static_cast<Language>(i) == Language::English) continue;
    const std::string code = code_of(static_cast<Language>(i));
    std::set<std::string> once;
    for (const std::string& key : entries(code, "msgid ")) {
      EXPECT_TRUE(texts.contains(key)) << code << ".po: no page says: " << key;
      EXPECT_TRUE(once.insert(key).second) << code << ".po has twice: " << key;
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
  for (const unsigned long n : {0UL, 1UL, 2UL, 5UL})
    forms.insert(words.plural("Everything is wiped in {} second.", "Everything is wiped in {} seconds.", n));
  EXPECT_EQ(forms.size(), 4U);
  // One and two are words, not figures.
  for (const unsigned long n : {1UL, 2UL}) {
    for (const auto& [one, many] :
         {std::pair("{} day", "{} days"), std::pair("In {} second everything goes back to what it was.",
                                                    "In {} seconds everything goes back to what it was.")})
      EXPECT_EQ(holes(words.plural(one, many, n)), 0U) << words.plural(one, many, n);
  }
  EXPECT_EQ(words.plural("Everything is wiped in {} second.", "Everything is wiped in {} seconds.", 103),
            std::string(
                words.plural("Everything is wiped in {} second.", "Everything is wiped in {} seconds.", 3)));
}

TEST_F(WordsTest, NothingIsOneInFrenchAndManyInSpanish) {
  const auto days = [](Language language, unsigned long n) {
    return std::string(Words(language).plural("{} day", "{} days", n));
  };
  EXPECT_EQ(days(Language::French, 0), days(Language::French, 1));
  EXPECT_NE(days(Language::French, 2), days(Language::French, 1));
  EXPECT_EQ(days(Language::Spanish, 0), days(Language::Spanish, 2));
  EXPECT_NE(days(Language::Spanish, 2), days(Language::Spanish, 1));
}

// What stands behind a breakable space, or behind none, in French; what opens and what closes in Spanish.
TEST_F(WordsTest, FrenchAndSpanishPunctuateAsTheirReadersDo) {
  for (const std::string& said : translations("fr")) {
    for (std::size_t at = said.find_first_of(":;?!"); at != std::string::npos;
         at = said.find_first_of(":;?!", at + 1)) {
      const bool inside_a_name = at + 1 < said.size() && said[at] == ':' && said[at + 1] != ' ';
      EXPECT_TRUE(inside_a_name || ends_with(said.substr(0, at), "\u00a0") ||
                  ends_with(said.substr(0, at), "\u202f"))
          << said;
    }
    EXPECT_EQ(said.find('\''), std::string::npos) << said;
  }
  for (const std::string& said : translations("es")) {
    EXPECT_EQ(count(said, "?"), count(said, "¿")) << said;
    EXPECT_EQ(count(said, "!"), count(said, "¡")) << said;
  }
}

TEST_F(WordsTest, HebrewCountsOneTwoAndManyChineseAndJapaneseDoNot) {
  const auto days = [](Language language, unsigned long n) {
    return std::string(Words(language).plural("{} day", "{} days", n));
  };
  EXPECT_NE(days(Language::Hebrew, 1), days(Language::Hebrew, 2));
  EXPECT_NE(days(Language::Hebrew, 2), days(Language::Hebrew, 3));
  EXPECT_EQ(days(Language::Hebrew, 0), days(Language::Hebrew, 3));
  for (const Language language : {Language::Chinese, Language::Japanese})
    EXPECT_EQ(days(language, 1), days(language, 365));
}

// Behind their letters no mark of half a width stands, and no letter of the one in the other.
TEST_F(WordsTest, ChineseAndJapanesePunctuateInFullWidth) {
  for (const char* code : {"zh", "ja"}) {
    for (const std::string& said : translations(code)) {
      const auto all = letters(said);
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (i + 1 < all.size() && is_east_asian(all[i])) {
          EXPECT_EQ(std::string(",.;:?!()").find(all[i + 1]), std::string::npos) << said;
        }
        if (std::string(code) == "zh") {
          EXPECT_FALSE(is_kana(all[i])) << said;
        }
      }
    }
  }
}

// Where words run to the left, a text that begins with a figure or a name says so, and what is read as one
// from the left is isolated.
TEST_F(WordsTest, FiguresAndNamesDoNotTurnArabicAndHebrewRound) {
  for (const char* code : {"ar", "he"}) {
    for (const std::string& said : translations(code)) {
      EXPECT_EQ(std::isalnum(static_cast<unsigned char>(said.front())), 0) << said;
      EXPECT_EQ(count(said, "\u2066"), count(said, "\u2069")) << said;
      // The sign stands beside its number, as StaffFrame::number() writes both.
      EXPECT_EQ(count(said, "{}%") + count(said, "{} %") + count(said, "{}\u00a0%"),
                count(said, "\u2066{}\u00a0%\u2069"))
          << said;
      for (std::size_t at = said.find('^'); at != std::string::npos; at = said.find('^', at + 1))
        EXPECT_GT(count(said.substr(0, at), "\u2066"), count(said.substr(0, at), "\u2069")) << said;
    }
  }
}

TEST_F(WordsTest, LanguagesChangeFromOneWordToTheNext) {
  EXPECT_STREQ(Words(Language::English)("Back"), "Back");
  EXPECT_STREQ(Words(Language::German)("Back"), "Zurück");
  EXPECT_STREQ(Words(Language::English)("Back"), "Back");
}

}  // namespace
}  // namespace relievo::ui

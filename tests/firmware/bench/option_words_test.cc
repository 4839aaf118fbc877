// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the algorithms say of their options, in the languages of the staff: every sentence of the catalogue of
// algorithms.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "pipeline/algorithms.h"
#include "ui/language/language.h"

namespace relievo::firmware {
namespace {

bool is_arabic(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) >= 0xD8 && static_cast<unsigned char>(c) <= 0xDB; });
}

TEST(OptionWords, EverySentenceIsInEveryLanguageOfTheStaff) {
  ASSERT_TRUE(ui::prepare_languages().has_value());
  std::set<std::string> sentences;
  for (const pipeline::OptionDescription& option : pipeline::describe_algorithms()) sentences.insert(option.sentence);
  ASSERT_GT(sentences.size(), 100U);
  for (const ui::Language language : ui::kStaffLanguages) {
    if (language == ui::Language::English) continue;
    const ui::Words words(language);
    std::set<std::string> said;
    for (const std::string& sentence : sentences) {
      EXPECT_TRUE(words.knows(sentence.c_str())) << ui::info_of(language).code << ".po lacks: " << sentence;
      if (!words.knows(sentence.c_str())) continue;
      const std::string other = words(sentence.c_str());
      EXPECT_TRUE(said.insert(other).second) << "two sentences became one: " << other;
      EXPECT_EQ(is_arabic(other), language == ui::Language::Arabic) << other;
      // Figures and the words of files are the same everywhere.
      for (const char* kept : {"MODE_HH", "QUALITY:DISTANCE_PX", "2^scales", "195"}) {
        EXPECT_EQ(sentence.find(kept) == std::string::npos, other.find(kept) == std::string::npos) << other;
      }
    }
  }
}

}  // namespace
}  // namespace relievo::firmware

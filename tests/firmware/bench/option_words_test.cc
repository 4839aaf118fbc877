// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the algorithms say of their options, in every language: every sentence of the catalogue of algorithms.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "pipeline/algorithms.h"
#include "ui/language/language.h"

namespace relievo::firmware {
namespace {

// A byte that begins a letter of a script.
bool has_lead(const std::string& text, unsigned first, unsigned last) {
  return std::any_of(text.begin(), text.end(), [=](char c) { return static_cast<unsigned char>(c) >= first && static_cast<unsigned char>(c) <= last; });
}

bool is_arabic(const std::string& text) { return has_lead(text, 0xD8, 0xDB); }
bool is_hebrew(const std::string& text) { return has_lead(text, 0xD7, 0xD7); }
bool is_east_asian(const std::string& text) { return has_lead(text, 0xE4, 0xE9); }  // Chinese letters

TEST(OptionWords, EverySentenceIsInEveryLanguage) {
  ASSERT_TRUE(ui::prepare_languages().has_value());
  std::set<std::string> sentences;
  for (const pipeline::OptionDescription& option : pipeline::describe_algorithms()) sentences.insert(option.sentence);
  ASSERT_GT(sentences.size(), 100U);
  for (std::size_t i = 0; i < ui::kLanguages; ++i) {
    const auto language = static_cast<ui::Language>(i);
    if (language == ui::Language::English) continue;
    const ui::Words words(language);
    std::set<std::string> said;
    for (const std::string& sentence : sentences) {
      EXPECT_TRUE(words.knows(sentence.c_str())) << ui::info_of(language).code << ".po lacks: " << sentence;
      if (!words.knows(sentence.c_str())) continue;
      const std::string other = words(sentence.c_str());
      EXPECT_TRUE(said.insert(other).second) << "two sentences became one: " << other;
      EXPECT_EQ(is_arabic(other), language == ui::Language::Arabic) << other;
      EXPECT_EQ(is_hebrew(other), language == ui::Language::Hebrew) << other;
      EXPECT_EQ(is_east_asian(other), language == ui::Language::Chinese || language == ui::Language::Japanese) << other;
      // Figures and the words of files are the same everywhere.
      for (const char* kept : {"MODE_HH", "QUALITY:DISTANCE_PX", "2^scales", "195"}) {
        EXPECT_EQ(sentence.find(kept) == std::string::npos, other.find(kept) == std::string::npos) << other;
      }
    }
  }
}

}  // namespace
}  // namespace relievo::firmware

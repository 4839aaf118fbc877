// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Languages, and the words of a screen in one of them. Words come from gettext catalogues
// (ui/language/*.po, compiled into ui's build folder); the key is the English text itself.
// One catalogue a language, all in the locale C.UTF-8: so languages change in the middle of a frame
// and no thread's environment is touched. Thread: any, once prepare_languages() has been called.
#pragma once

#include <cstdint>

#include "hal/base/result.h"

namespace relievo::ui {

enum class Language : std::uint8_t {
  English,
  German,
  French,
  Spanish,
  Arabic,
  Hebrew,
  Chinese,
  Japanese,
  Count
};
inline constexpr std::size_t kLanguages = std::size_t(Language::Count);

struct LanguageInfo {
  const char* code;      // BCP 47
  const char* own_name;  // as its speakers write it
  bool right_to_left;
  bool latin;  // typed with Latin letters; Chinese and Japanese names are, as in a passport
  char decimal_mark;
};
const LanguageInfo& info_of(Language language);

// Once, at start, before other threads run. Errors: NotFound (no catalogues: where() has the folder),
// LibraryFailed (the system has no C.UTF-8).
Result<void> prepare_languages();

class Words {
 public:
  explicit Words(Language language) : language_(language) {}
  Language language() const { return language_; }
  const char* operator()(const char* english) const;
  // The form that belongs to the number: Arabic has six.
  const char* plural(const char* one, const char* many, unsigned long number) const;
  // Has the catalogue this text? English has every one.
  bool knows(const char* english) const;

 private:
  Language language_;
};

// Marks words for the catalogues that stand in a table: who draws them translates them.
constexpr const char* mark_tr(const char* english) { return english; }

}  // namespace relievo::ui

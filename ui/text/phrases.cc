// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/text/pango_paragraph.h"

#include <algorithm>
#include <cstdint>

#include "hal/base/utf8.h"

namespace relievo::ui {
namespace {

enum class Kind : std::uint8_t { Hiragana, Katakana, Kanji, Latin, Ends, Opens };

struct Letter {
  std::size_t at;
  char32_t code;
};

std::vector<Letter> letters_of(std::string_view text) {
  std::vector<Letter> letters;
  for (std::size_t at = 0; at < text.size();) {
    const Utf8Letter letter = first_letter_of(text.substr(at));
    letters.push_back({at, letter.code});
    at += std::max<std::size_t>(1, letter.bytes);
  }
  return letters;
}

bool is_one_of(char32_t code, std::u32string_view set) { return set.find(code) != std::u32string_view::npos; }

Kind kind_of(char32_t code) {
  if (is_one_of(code, U"、。，！？：；）」』”")) return Kind::Ends;
  if (is_one_of(code, U"（「『“")) return Kind::Opens;
  if (code >= 0x3041 && code <= 0x309F) return Kind::Hiragana;
  if (code >= 0x30A0 && code <= 0x30FF) return Kind::Katakana;
  return code < 0x2E80 ? Kind::Latin : Kind::Kanji;
}

bool is_prefix(const std::vector<Letter>& letters, std::size_t i) {
  return is_one_of(letters[i].code, U"おご") && i + 1 < letters.size() &&
         kind_of(letters[i + 1].code) == Kind::Kanji;
}

// The one letter between two kanji of a verb made of two: 撮り直す, 計測し直す.
bool joins_a_verb(const std::vector<Letter>& letters, std::size_t i) {
  return i > 0 && is_one_of(letters[i].code, U"いきしちみりえけげめれ") &&
         kind_of(letters[i - 1].code) == Kind::Kanji;
}

// Words that lean on what follows them: もう一度, 何も保存されません, あと9秒. The length of one that ends
// before `i`, or 0.
std::size_t leaning_word_before(const std::vector<Letter>& letters, std::size_t i) {
  for (const std::u32string_view word : {U"もう", U"何も", U"あと"}) {
    const std::size_t length = word.size();
    if (i >= length &&
        std::ranges::equal(word, std::span(letters).subspan(i - length, length), {}, {}, &Letter::code))
      return length;
  }
  return 0;
}

bool begins_a_leaning_word(const std::vector<Letter>& letters, std::size_t i) {
  return i + 2 < letters.size() && kind_of(letters[i + 2].code) != Kind::Hiragana &&
         leaning_word_before(letters, i + 2) == 2;
}

bool begins_word(const std::vector<Letter>& letters, std::size_t i) {
  const Kind before = kind_of(letters[i - 1].code), here = kind_of(letters[i].code);
  if (is_prefix(letters, i) || begins_a_leaning_word(letters, i)) return true;
  if (before != Kind::Hiragana || here == Kind::Hiragana || is_prefix(letters, i - 1) ||
      leaning_word_before(letters, i) > 0)
    return false;
  return here != Kind::Kanji || !joins_a_verb(letters, i - 1);
}

std::vector<std::size_t> full_lines(std::span<const float> widths, float width) {
  std::vector<std::size_t> starts;
  float line = widths.empty() ? 0 : widths[0];
  for (std::size_t i = 1; i < widths.size(); ++i) {
    if (line + widths[i] > width) starts.push_back(i), line = 0;
    line += widths[i];
  }
  return starts;
}

}  // namespace

std::vector<std::size_t> phrase_starts(std::string_view text, bool japanese) {
  const std::vector<Letter> letters = letters_of(text);
  std::vector<std::size_t> starts;
  for (std::size_t i = 1; i < letters.size(); ++i) {
    const Kind before = kind_of(letters[i - 1].code), here = kind_of(letters[i].code);
    if (here == Kind::Ends || before == Kind::Opens) continue;
    if (before == Kind::Ends || here == Kind::Opens || (japanese && begins_word(letters, i)))
      starts.push_back(letters[i].at);
  }
  return starts;
}

std::vector<std::size_t> sentence_starts(std::string_view text) {
  const std::vector<Letter> letters = letters_of(text);
  std::vector<std::size_t> starts;
  for (std::size_t i = 2; i < letters.size(); ++i) {
    if (letters[i - 1].code == U' ' && is_one_of(letters[i - 2].code, U".!?\u061f"))
      starts.push_back(letters[i].at);
  }
  return starts;
}

std::vector<std::size_t> fill_lines(std::span<const float> widths, float width, bool evened) {
  std::vector<std::size_t> starts = full_lines(widths, width);
  if (!evened || starts.empty()) return starts;
  const std::size_t lines = starts.size();
  float too_narrow = 0;
  while (width - too_narrow > 0.5F) {
    const float middle = (too_narrow + width) / 2;
    std::vector<std::size_t> tried = full_lines(widths, middle);
    const bool fits =
        tried.size() == lines && std::ranges::none_of(widths, [middle](float one) { return one > middle; });
    if (fits) starts = std::move(tried), width = middle;
    else too_narrow = middle;
  }
  return starts;
}

}  // namespace relievo::ui

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a visitor types or shows: their name, in memory of its own that is wiped.
#include <string.h>

#include "ui/view/keypad_letters.h"
#include "ui/view/visit.h"

namespace relievo::ui {
namespace {

constexpr std::chrono::milliseconds kSameKey{1000};  // within it a key means its next letter

}  // namespace

void Visit::type(std::string_view letter) {
  if (step != Step::Name || overlay != Overlay::None) return;
  digit_ = 0;
  if (quotes_code_) return type_code(letter);
  if (length_ + letter.size() > name_.size()) return;
  if (letter == " " && (length_ == 0 || name_[length_ - 1] == ' ')) return;
  letter.copy(name_.data() + length_, letter.size());
  length_ += letter.size();
  capitals = letter == " " || letter == "-";
  accents = false;
}

// Its digits alone: they are grouped where they are shown.
void Visit::type_code(std::string_view letters) {
  for (const char c : letters)
    if (c >= '0' && c <= '9' && length_ < kCodeDigits) name_[length_++] = c;
}

void Visit::type_by_digit(char digit, hal::Instant now) {
  if (quotes_code_) return type_code({&digit, 1});
  const bool again = digit == digit_ && now - digit_at_ < kSameKey;
  const std::size_t times = again ? digit_times_ + 1 : 0;
  if (again) erase_letter();
  type(keypad_letter(language, digit, times, capitals));
  digit_ = digit;
  digit_times_ = times;
  digit_at_ = now;
}

void Visit::enter(std::string_view text, hal::Instant now) {
  if (step != Step::Name || overlay != Overlay::None || length_ > 0 || text.size() > name_.size()) return;
  touched(now);
  if (quotes_code_) return type_code(text);
  length_ = text.copy(name_.data(), text.size());
  capitals = accents = false;
}

void Visit::erase_letter() {
  digit_ = 0;
  while (length_ > 0) {
    const char last = name_[--length_];
    name_[length_] = 0;
    if ((static_cast<unsigned char>(last) & 0xC0U) != 0x80U) break;  // the first byte of a letter
  }
  capitals = length_ == 0 || name_[length_ - 1] == ' ' || name_[length_ - 1] == '-';
}

void Visit::wipe_name() {
  explicit_bzero(name_.data(), name_.size());
  length_ = 0;
}

}  // namespace relievo::ui

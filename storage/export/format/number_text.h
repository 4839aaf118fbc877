// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers as text, in every locale: exact, or rounded to a number of decimals.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>

namespace relievo::storage {

template <typename Number>
void append_number(std::string& text, Number value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

// Rounded to `decimals`, without zeros at the end: -12.5, 0, 3. Finite, and below 1e9.
inline void append_rounded(std::string& text, double value, int decimals) {
  std::int64_t one = 1;
  for (int i = 0; i < decimals; ++i) one *= 10;
  std::int64_t scaled = std::llround(value * double(one));
  if (scaled < 0) {
    text += '-';
    scaled = -scaled;
  }
  append_number(text, scaled / one);
  std::int64_t rest = scaled % one;
  if (rest == 0) return;
  text += '.';
  for (one /= 10; rest != 0; one /= 10) {
    text += char('0' + rest / one);
    rest %= one;
  }
}

template <typename Number>
std::string number_text(Number value) {
  std::string text;
  append_number(text, value);
  return text;
}

}  // namespace relievo::storage

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// UTF-8 as Unicode 15 has it (table 3-7): nothing overlong, no surrogates. Thread: any. Errors: none.
#pragma once

#include <cstddef>
#include <string_view>

namespace relievo {

struct Utf8Letter {
  char32_t code = 0;
  std::size_t bytes = 0;  // 0: no whole character stands there
};

inline Utf8Letter first_letter_of(std::string_view text) {
  const auto byte = [text](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return {first, text.empty() ? 0U : 1U};
  if (first < 0xC2 || first > 0xF4) return {};
  const std::size_t bytes = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  char32_t code = first & (0x7FU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    code = code << 6U | (byte(i) & 0x3FU);
  }
  const bool overlong = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
  if (overlong || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return {};
  return {code, bytes};
}

// Where the last character begins; 0 in an empty text.
inline std::size_t last_letter_at(std::string_view text) {
  std::size_t at = text.size();
  while (at > 0 && (static_cast<unsigned char>(text[--at]) & 0xC0U) == 0x80U) {
  }
  return at;
}

inline bool is_control(char32_t code) { return code < 0x20 || (code >= 0x7F && code < 0xA0); }

// Turns the words around it, or ends their line.
inline bool is_steering(char32_t code) {
  return code == 0x061C || code == 0x200E || code == 0x200F || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069);
}

}  // namespace relievo

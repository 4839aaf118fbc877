// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/text.h"

#include <algorithm>

#include "storage/record.h"

namespace relievo::storage {
namespace {

// Bytes of the character at the front, 0 if it is malformed, overlong, a surrogate or a control.
std::size_t character_bytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto in = [](unsigned value, unsigned low, unsigned high) { return value >= low && value <= high; };
  const auto tail = [&](std::size_t i) { return in(byte(i), 0x80, 0xBF); };
  const unsigned first = byte(0);
  if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
  if (in(first, 0xC2, 0xDF)) return tail(1) && !(first == 0xC2 && byte(1) < 0xA0) ? 2 : 0;
  if (in(first, 0xE0, 0xEF)) {
    return in(byte(1), first == 0xE0 ? 0xA0 : 0x80, first == 0xED ? 0x9F : 0xBF) && tail(2) ? 3 : 0;
  }
  if (in(first, 0xF0, 0xF4)) {
    return in(byte(1), first == 0xF0 ? 0x90 : 0x80, first == 0xF4 ? 0x8F : 0xBF) && tail(2) && tail(3) ? 4
                                                                                                       : 0;
  }
  return 0;
}

char lower(char c) { return c >= 'A' && c <= 'Z' ? char(c + ('a' - 'A')) : c; }

}  // namespace

bool is_name(std::string_view text) {
  if (text.empty() || text.size() > kMaxNameBytes) return false;
  while (!text.empty()) {
    const std::size_t bytes = character_bytes(text);
    if (bytes == 0) return false;
    text.remove_prefix(bytes);
  }
  return true;
}

bool contains_name(std::string_view name, std::string_view part) {
  const auto alike = [](char a, char b) { return lower(a) == lower(b); };
  return part.empty() || std::search(name.begin(), name.end(), part.begin(), part.end(), alike) != name.end();
}

std::string first_letter(std::string_view name) {
  name.remove_prefix(std::min(name.size(), name.find_first_not_of(' ')));
  std::string letter(name.substr(0, character_bytes(name)));
  if (letter.size() == 1 && letter[0] >= 'a' && letter[0] <= 'z') letter[0] = char(letter[0] - ('a' - 'A'));
  return letter;
}

std::string normal_name(std::string_view name) {
  const std::size_t first = name.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  std::string normal(name.substr(first, name.find_last_not_of(' ') - first + 1));
  for (char& c : normal) c = lower(c);
  return normal;
}

}  // namespace relievo::storage

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/text.h"

#include <algorithm>

#include "hal/base/utf8.h"
#include "storage/record.h"

namespace relievo::storage {

char small_letter(char c) { return c >= 'A' && c <= 'Z' ? char(c + ('a' - 'A')) : c; }

bool is_name(std::string_view text) {
  if (text.empty() || text.size() > kMaxNameBytes) return false;
  for (Utf8Letter letter; !text.empty(); text.remove_prefix(letter.bytes)) {
    letter = first_letter_of(text);
    if (letter.bytes == 0 || is_control(letter.code)) return false;
  }
  return true;
}

bool contains_name(std::string_view name, std::string_view part) {
  const auto alike = [](char a, char b) { return small_letter(a) == small_letter(b); };
  return part.empty() || std::search(name.begin(), name.end(), part.begin(), part.end(), alike) != name.end();
}

std::string first_letter(std::string_view name) {
  name.remove_prefix(std::min(name.size(), name.find_first_not_of(' ')));
  std::string letter(name.substr(0, first_letter_of(name).bytes));
  if (letter.size() == 1 && letter[0] >= 'a' && letter[0] <= 'z') letter[0] = char(letter[0] - ('a' - 'A'));
  return letter;
}

std::string normal_name(std::string_view name) {
  const std::size_t first = name.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  std::string normal(name.substr(first, name.find_last_not_of(' ') - first + 1));
  std::ranges::transform(normal, normal.begin(), small_letter);
  return normal;
}

std::vector<std::string_view> split(std::string_view text, char mark) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0, end = 0; begin <= text.size(); begin = end + 1) {
    end = std::min(text.find(mark, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
  }
  return parts;
}

}  // namespace relievo::storage

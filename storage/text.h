// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Names as people write them, and words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace relievo::storage {

// 1 to kMaxNameBytes bytes of well-formed UTF-8 (Unicode 15, table 3-7), no control characters.
bool is_name(std::string_view text);

// An ASCII letter as a small one, all others as they are.
char small_letter(char c);

// `part` anywhere in `name`; ASCII letters in either case, all others as they are.
bool contains_name(std::string_view name, std::string_view part);

// What a name is found under in a list: its first character, an ASCII letter as a capital. Empty: no name.
std::string first_letter(std::string_view name);

// Two names that are written alike but for ASCII capitals and spaces around them are one.
std::string normal_name(std::string_view name);

// What stands between the marks, before the first and behind the last: one more than there are marks.
std::vector<std::string_view> split(std::string_view text, char mark);

}  // namespace relievo::storage

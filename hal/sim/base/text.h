// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// text(): printf into a string. The formats are ours, the lengths short (at most 511 bytes).
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace relievo::hal::sim {

template <typename... Values>
std::string text(const char* format, Values... values) {
  std::array<char, 512> buffer{};
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
#pragma GCC diagnostic ignored "-Wformat-security"
  std::snprintf(buffer.data(), buffer.size(), format, values...);
#pragma GCC diagnostic pop
  return buffer.data();
}

}  // namespace relievo::hal::sim

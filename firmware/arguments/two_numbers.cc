// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/arguments/two_numbers.h"

#include <charconv>
#include <system_error>

namespace relievo::firmware {

std::optional<TwoNumbers> two_numbers(std::string_view text, char between) {
  TwoNumbers numbers;
  const char* end = text.data() + text.size();
  const auto [after_first, bad_first] = std::from_chars(text.data(), end, numbers.first);
  if (bad_first != std::errc() || after_first == end || *after_first != between) return std::nullopt;
  const auto [after_second, bad_second] = std::from_chars(after_first + 1, end, numbers.second);
  return bad_second == std::errc() && after_second == end ? std::optional(numbers) : std::nullopt;
}

}  // namespace relievo::firmware

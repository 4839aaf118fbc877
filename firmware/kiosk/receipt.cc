// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/receipt.h"

#include <charconv>
#include <cstdio>

namespace relievo::firmware {
namespace {

int check_digits(std::int64_t number) { return static_cast<int>(98 - (number % 97 * 100) % 97); }

}  // namespace

std::string receipt_of(storage::SubjectId subject) {
  const auto number = static_cast<std::int64_t>(subject);
  char text[40];
  std::snprintf(text, sizeof text, "%06lld-%02d", static_cast<long long>(number), check_digits(number));
  return text;
}

std::optional<storage::SubjectId> subject_of_receipt(std::string_view code) {
  const std::size_t dash = code.find('-');
  if (dash < 6 || dash > 18 || code.size() != dash + 3) return std::nullopt;
  std::int64_t number = 0;
  int check = 0;
  const char* const end = code.data() + code.size();
  if (std::from_chars(code.data(), code.data() + dash, number).ptr != code.data() + dash) return std::nullopt;
  if (std::from_chars(code.data() + dash + 1, end, check).ptr != end) return std::nullopt;
  if (number <= 0 || check != check_digits(number)) return std::nullopt;
  return storage::SubjectId{number};
}

}  // namespace relievo::firmware

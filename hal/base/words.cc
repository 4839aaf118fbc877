// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/base/words.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>

#include "hal/base/utf8.h"

namespace relievo {

std::string printed(const char* format, ...) {  // NOLINT(cert-dcl50-cpp): as printf() has them
  char text[512];
  std::va_list values;
  va_start(values, format);
  std::vsnprintf(text, sizeof text, format, values);
  va_end(values);
  return text;
}

std::string decimal(double number, int decimals, bool with_sign) {
  if (std::isnan(number)) return "-";
  char text[48];
  std::snprintf(text, sizeof text, with_sign ? "%+.*f" : "%.*f", decimals, number);
  return text;
}

std::string filled(std::string_view pattern, std::initializer_list<std::string_view> values) {
  std::string text;
  for (const std::string_view value : values) {
    const std::size_t hole = pattern.find("{}");
    if (hole == std::string_view::npos) break;
    text.append(pattern.substr(0, hole)).append(value);
    pattern.remove_prefix(hole + 2);
  }
  return text.append(pattern);
}

std::string shown_name(std::string_view name) {
  std::string shown;
  while (!name.empty()) {
    const Utf8Letter letter = first_letter_of(name);
    const std::string_view one = name.substr(0, std::max<std::size_t>(letter.bytes, 1));
    name.remove_prefix(one.size());
    if (letter.bytes == 0 || is_control(letter.code) || is_steering(letter.code)) shown += '?';
    else shown += one;
  }
  return shown;
}

Error meaning_of(int number, std::span<const Meaning> rows) {
  const auto row = std::ranges::find_if(rows, [number](const Meaning& one) {
    return one.numbers[0] == 0 ||
           (number != 0 && std::ranges::find(one.numbers, number) != one.numbers.end());
  });
  return {row->code, row->what, number};
}

std::string detail_of(const Error& error) {
  std::string line;
  if (!error.where().empty()) line.append(error.where()).append(": ");
  line.append(error.what.view());
  if (error.sys_errno != 0) line.append(" (").append(std::strerror(error.sys_errno)).append(")");
  return shown_name(line);
}

}  // namespace relievo

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/base/options.h"

#include <charconv>
#include <cmath>
#include <locale>
#include <sstream>

namespace relievo::pipeline {

bool OptionRange::holds(double value) const {
  return value >= least && value <= most && (step == 0 || std::remainder(value - least, step) == 0);
}

std::string OptionRange::possible() const {
  std::string text;
  for (const char* name : names) text += (text.empty() ? "" : " or ") + std::string(name);
  if (!names.empty()) return text;
  text = number_text(least) + " to " + number_text(most);
  return step == 0 ? text : text + " in steps of " + number_text(step);
}

Error out_of_range(const std::string& option, const std::string& value, const OptionRange& range) {
  return invalid("not one of the values in brackets")
      .at(option + " = " + value + " (" + range.possible() + ")");
}

std::vector<std::string> split_names(std::string_view text) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t plus = text.find('+');
    parts.emplace_back(text.substr(0, plus));
    if (plus == std::string_view::npos) return parts;
    text.remove_prefix(plus + 1);
  }
}

std::optional<double> number_in(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string number_text(double value, int digits) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(digits);
  out << value;
  return out.str();
}

}  // namespace relievo::pipeline

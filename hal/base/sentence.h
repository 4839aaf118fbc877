// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sentence: words for people with values in them, kept apart, so that the words can be said in another
// language. The key is the English text with {} for each value, in their order; values are text already (a
// number with a point for its decimals, a name), units stand in the key. Tabs and line ends in a value become
// blanks.
//
// Packed, it is one line for a store, a log or a page: KEY, then a tab and a value for each.
// Errors: none but those of memory. Thread: any.
#pragma once

#include <algorithm>
#include <cstdio>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.h"

namespace relievo {

class Sentence {
 public:
  explicit Sentence(Literal key, std::initializer_list<std::string_view> values = {}) : key_(key.view()) {
    for (const std::string_view value : values) add(value);
  }
  // An error's words, and behind them in parentheses where it was.
  explicit Sentence(const Error& error) : key_(error.what.view()) {
    if (!error.where().empty()) add(error.where());
  }

  std::string_view key() const { return key_; }

  // In English. Values for which the key has no place stand behind it in parentheses.
  std::string text() const {
    std::string said;
    std::string_view rest = key_;
    for (const std::string& value : values_) {
      const std::size_t hole = rest.find("{}");
      if (hole == std::string_view::npos) {
        said.append(rest).append(" (").append(value).append(")");
        rest = {};
        continue;
      }
      said.append(rest.substr(0, hole)).append(value);
      rest.remove_prefix(hole + 2);
    }
    return said.append(rest);
  }

  std::string packed() const {
    std::string line(key_);
    for (const std::string& value : values_) line.append(1, '\t').append(value);
    return line;
  }

 private:
  void add(std::string_view value) {
    std::string& added = values_.emplace_back(value);
    std::replace_if(
        added.begin(), added.end(), [](char c) { return c == '\t' || c == '\n'; }, ' ');
  }

  std::string_view key_;  // a literal's
  std::vector<std::string> values_;
};

// As a value of a sentence.
inline std::string decimal(double number, int decimals, bool with_sign = false) {
  char text[48];
  std::snprintf(text, sizeof text, with_sign ? "%+.*f" : "%.*f", decimals, number);
  return text;
}

}  // namespace relievo

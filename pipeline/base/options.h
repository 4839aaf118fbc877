// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How an algorithm's settings describe themselves, once: a struct with settings has a member function
//
//   void describe(auto&& field) {
//     field("window_px", window_px, OptionRange{3, 63, 2}, "side of the window, pixels, odd");
//     field("mode", mode, OptionRange{.names = kModes}, "3way: three paths, hh: eight paths");
//   }
//
// from which `--set`, the TOML file, the technician's page, the documentation and check_options() are made.
// Numbers have a range, enum classes a name for each value, std::string is any text, a TextFile a path.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "hal/base/result.h"

namespace relievo::pipeline {

struct OptionRange {
  double least = 0;
  double most = 0;
  double step = 0;                          // of a number: counted from `least`; 0: any
  std::span<const char* const> names = {};  // of an enum class, one a value from 0 on

  bool holds(double value) const;  // not a number is outside
  std::string possible() const;    // "3 to 63 in steps of 2", "3way or hh"
};

// An integer's values are whole.
template <typename Value>
OptionRange range_of(OptionRange range) {
  if (std::is_integral_v<Value> && range.step == 0) range.step = 1;
  return range;
}

// "sgm.band", "3": InvalidInput, with what would be possible.
Error out_of_range(const std::string& option, const std::string& value, const OptionRange& range);

// Names joined by '+', apart.
std::vector<std::string> split_names(std::string_view text);

// To ten digits, a float's to six.
std::string number_text(double value, int digits = 10);
// The number that all of the text is, written with a point whatever the locale; "inf" and "nan" are some.
std::optional<double> number_in(std::string_view text);

// An option that names a file. No algorithm opens one: who makes the choice reads it
// (AlgorithmSet::keep_text), so that a saved reconstruction has what it was calculated with.
struct TextFile {
  std::string path;
  std::shared_ptr<const std::string> text = {};  // null: it was not read
};

// A value as it is shown, and read again.
template <typename Value>
std::string option_text(const Value& value, const OptionRange& range) {
  if constexpr (std::is_same_v<Value, std::string>) return value;
  else if constexpr (std::is_same_v<Value, TextFile>) return value.path;
  else if constexpr (std::is_enum_v<Value>) return range.names[std::size_t(value)];
  else return number_text(double(value), std::is_same_v<Value, float> ? 6 : 10);
}

template <typename Options>
void describe(Options& options, auto&& field) {
  if constexpr (requires { options.describe(field); }) options.describe(field);
}

// Errors: InvalidInput for the first number outside of its range; what the struct's own check() says, if it
// has one, of options that do not fit together.
template <typename Options>
Result<void> check_options(const Options& options, std::string_view algorithm) {
  constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
  Result<void> checked;
  Options copy = options;  // describe() is for writing, too
  describe(copy, [&](const char* name, const auto& value, const OptionRange& range, const char*) {
    if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(value)>>)
      // A float as it was written: 0.01F is a little less than 0.01.
      if (checked && !range.holds(number_in(option_text(value, range)).value_or(kNoNumber)))
        checked = out_of_range(std::string(algorithm) + "." + name, option_text(value, range),
                               range_of<std::remove_cvref_t<decltype(value)>>(range));
  });
  if constexpr (requires { options.check(); })
    if (checked) return options.check();
  return checked;
}

}  // namespace relievo::pipeline

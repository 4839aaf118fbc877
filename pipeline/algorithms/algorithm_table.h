// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tables of algorithms: one line an algorithm, `with_options<Matcher, SsdMatcher,
// SsdMatcherOptions>({name, what it is, source})`, is all that its name on the command line, its options,
// their documentation and its making need.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "pipeline/algorithms.h"
#include "pipeline/base/options.h"

namespace relievo::pipeline {

// A kind of algorithm and what it may be.
struct Kind {
  const char* key;
  const char* value;  // the default
  const char* sentence;
  std::vector<AlgorithmDescription> algorithms;
  bool several = false;  // names joined by '+'
};

std::vector<Kind> match_kinds();
std::vector<Kind> surface_kinds();
std::vector<OptionDescription> match_options();
std::vector<OptionDescription> surface_options();

// Names joined by '+', apart.
std::vector<std::string> split_names(std::string_view text);

// Adds the options of one algorithm of this kind, as they are by default.
template <typename Options>
void describe_options(std::string_view kind, std::string_view section, std::vector<OptionDescription>& all) {
  Options options;
  describe(options, [&](const char* name, auto& value, const OptionRange& range, const char* sentence) {
    OptionDescription one;
    one.key = std::string(section) + "." + name;
    one.value = option_text(value, range);
    one.sentence = sentence;
    one.names.assign(range.names.begin(), range.names.end());
    one.range = range;
    using Value = std::remove_reference_t<decltype(value)>;
    one.file = std::is_same_v<Value, TextFile>;
    one.text = one.file || std::is_same_v<Value, std::string>;
    one.kind = kind;
    all.push_back(std::move(one));
  });
}

// Reads one algorithm's options out of the set. The set has checked that numbers are numbers in range,
// and names known.
class OptionReader {
 public:
  template <typename Options>
  static Result<Options> read(const AlgorithmSet& set, std::string_view section) {
    Options options;
    describe(options, [&](const char* name, auto& value, const OptionRange& range, const char*) {
      using Value = std::remove_reference_t<decltype(value)>;
      const std::string key = std::string(section) + "." + name;
      const auto chosen = set.chosen_.find(key);
      if (chosen == set.chosen_.end()) return;
      if constexpr (std::is_same_v<Value, std::string>) value = chosen->second;
      else if constexpr (std::is_same_v<Value, TextFile>) {
        const auto read = set.texts_.find(key);
        value = {chosen->second, read == set.texts_.end() ? nullptr : read->second};
      } else if constexpr (std::is_enum_v<Value>)
        value = static_cast<Value>(std::find(range.names.begin(), range.names.end(), chosen->second) -
                                   range.names.begin());
      else value = static_cast<Value>(number(chosen->second));
    });
    RELIEVO_TRY(check_options(options, section));
    return options;
  }

 private:
  static double number(const std::string& text);
};

template <typename Interface>
struct Algorithm {
  AlgorithmDescription about;
  Result<std::unique_ptr<Interface>> (*make)(const AlgorithmSet& set, std::string_view section);
  void (*describe)(std::string_view kind, std::string_view section, std::vector<OptionDescription>& all);
};

template <typename Interface, typename Concrete, typename Options>
constexpr Algorithm<Interface> with_options(const AlgorithmDescription& about) {
  return {about,
          [](const AlgorithmSet& set, std::string_view section) -> Result<std::unique_ptr<Interface>> {
            RELIEVO_TRY_ASSIGN(const Options options, OptionReader::read<Options>(set, section));
            return std::unique_ptr<Interface>(std::make_unique<Concrete>(options));
          },
          [](std::string_view kind, std::string_view section, std::vector<OptionDescription>& all) {
            describe_options<Options>(kind, section, all);
          }};
}

template <typename Interface, typename Concrete>
constexpr Algorithm<Interface> without_options(const AlgorithmDescription& about) {
  return {about,
          [](const AlgorithmSet&, std::string_view) -> Result<std::unique_ptr<Interface>> {
            return std::unique_ptr<Interface>(std::make_unique<Concrete>());
          },
          [](std::string_view, std::string_view, std::vector<OptionDescription>&) {}};
}

template <typename Table>
Kind kind_of(const char* key, const char* value, const char* sentence, const Table& table) {
  Kind kind{key, value, sentence, {}};
  for (const auto& algorithm : table) kind.algorithms.push_back(algorithm.about);
  return kind;
}

template <typename Table>
void describe_table(std::string_view kind, const Table& table, std::vector<OptionDescription>& all) {
  for (const auto& algorithm : table) algorithm.describe(kind, algorithm.about.name, all);
}

template <typename Interface, typename Table>
Result<std::unique_ptr<Interface>> make_named(const Table& table, const AlgorithmSet& set,
                                              std::string_view name) {
  for (const Algorithm<Interface>& algorithm : table)
    if (name == algorithm.about.name) return algorithm.make(set, algorithm.about.name);
  return Error{Errc::NotFound, "no such algorithm"}.at(name);
}

}  // namespace relievo::pipeline

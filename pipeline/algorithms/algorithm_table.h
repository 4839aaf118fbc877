// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tables of algorithms: one line an algorithm, `algorithm<&SsdMatcher::match>({name, what it is,
// source})`, is all that its name on the command line, its options, their documentation and its making need.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
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
  std::vector<OptionDescription> options = {};  // of all of them
  bool several = false;                         // names joined by '+'
};

std::vector<Kind> match_kinds();
std::vector<Kind> surface_kinds();

// Adds the options of one algorithm to its kind's, as they are by default.
template <typename Options>
void describe_options(std::string_view section, Kind& kind) {
  Options options;
  describe(options, [&](const char* name, auto& value, const OptionRange& range, const char* sentence) {
    OptionDescription one;
    one.key = std::string(section) + "." + name;
    one.value = option_text(value, range);
    one.sentence = sentence;
    one.names.assign(range.names.begin(), range.names.end());
    using Value = std::remove_reference_t<decltype(value)>;
    one.range = range_of<Value>(range);
    one.file = std::is_same_v<Value, TextFile>;
    one.text = one.file || std::is_same_v<Value, std::string>;
    one.kind = kind.key;
    kind.options.push_back(std::move(one));
  });
}

// Reads one algorithm's options out of the set, which has checked numbers and names.
struct OptionReader {
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
        value = static_cast<Value>(std::ranges::find(range.names, chosen->second) - range.names.begin());
      else value = static_cast<Value>(std::strtod(chosen->second.c_str(), nullptr));
    });
    RELIEVO_TRY(check_options(options, section));
    return options;
  }
};

template <typename Form>  // one of the kinds: a std::function
struct Algorithm {
  AlgorithmDescription about;
  Result<Form> (*make)(const AlgorithmSet& set, std::string_view section);
  void (*describe)(std::string_view section, Kind& kind);
};

template <auto kRun, typename Options, typename Returned, typename... Taken>
constexpr auto algorithm(const AlgorithmDescription& about, Returned (Options::*)(Taken...) const) {
  using Form = std::function<Returned(Taken...)>;
  return Algorithm<Form>{about,
                         [](const AlgorithmSet& set, std::string_view section) -> Result<Form> {
                           RELIEVO_TRY_ASSIGN(const Options options,
                                              OptionReader::read<Options>(set, section));
                           return Form(std::bind_front(kRun, options));
                         },
                         describe_options<Options>};
}

template <auto kRun>
constexpr auto algorithm(const AlgorithmDescription& about) {
  return algorithm<kRun>(about, kRun);
}

template <typename Table>
Kind kind_of(const char* key, const char* value, const char* sentence, const Table& table) {
  Kind kind{key, value, sentence, {}};
  for (const auto& algorithm : table) {
    kind.algorithms.push_back(algorithm.about);
    algorithm.describe(algorithm.about.name, kind);
  }
  return kind;
}

// "none", which is in no table, makes an empty function.
template <typename Form, std::size_t kCount>
Result<Form> make_named(const std::array<Algorithm<Form>, kCount>& table, const AlgorithmSet& set,
                        std::string_view name) {
  for (const Algorithm<Form>& algorithm : table)
    if (name == algorithm.about.name) return algorithm.make(set, name);
  return Form();
}

}  // namespace relievo::pipeline

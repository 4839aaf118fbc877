// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/compare/set_choice.h"

#include <algorithm>
#include <string_view>

#include "firmware/arguments/algorithm_choice.h"
#include "firmware/arguments/settings_file.h"
#include "firmware/compare/suites.h"

namespace relievo::firmware::compare {
namespace {

// "SSD 21: matcher=ssd ssd.window_px=21"
Result<SetWords> words_of(const std::string& text) {
  const std::size_t colon = text.find(':');
  SetWords words;
  words.name = text.substr(0, std::min(colon, text.size()));
  if (colon == std::string::npos || words.name.find_first_not_of(' ') == std::string::npos)
    return Error{Errc::InvalidInput,
                 "is no set: write \"NAME: KEY=VALUE KEY=VALUE\", as in \"SSD: matcher=ssd\""}
        .at(text);
  std::string_view rest = std::string_view(text).substr(colon + 1);
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (end > 0) words.settings.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(rest.size(), end + 1));
  }
  return words;
}

// The error of a set names it.
Error in_set(const Error& error, const std::string& name) {
  return error.at("set '" + name + "': " + std::string(error.where()));
}

// Whether it can be made at all: before anything is computed.
Result<void> try_to_make(const pipeline::AlgorithmSet& set) {
  if (const auto made = pipeline::make_preprocessor(set); !made) return made.error();
  if (const auto made = pipeline::make_selector(set); !made) return made.error();
  if (const auto made = pipeline::make_matcher(set); !made) return made.error();
  if (const auto made = pipeline::make_constraints(set); !made) return made.error();
  if (const auto made = pipeline::make_triangulator(set); !made) return made.error();
  if (const auto made = pipeline::make_mesher(set); !made) return made.error();
  if (const auto made = pipeline::make_texturer(set); !made) return made.error();
  return {};
}

Result<NamedSet> named_set(const AlgorithmArgs& base, const SetWords& words) {
  AlgorithmArgs all = base;
  all.settings.insert(all.settings.end(), words.settings.begin(), words.settings.end());
  const auto set = choose_algorithms(all);
  if (!set) return in_set(set.error(), words.name);
  if (const auto made = try_to_make(*set); !made) return in_set(made.error(), words.name);
  return NamedSet{words.name, *set};
}

Result<std::vector<SetWords>> all_words(const CompareArgs& args) {
  std::vector<SetWords> all;
  for (const std::string& name : args.suites) {
    RELIEVO_TRY_ASSIGN(const auto suite, suite_sets(name));
    all.insert(all.end(), suite.begin(), suite.end());
  }
  for (const Path& file : args.set_files) {
    RELIEVO_TRY_ASSIGN(const auto sets, read_sets_file(file));
    for (const auto& [name, settings] : sets) all.push_back({name, settings});
  }
  for (const std::string& text : args.set_words) {
    RELIEVO_TRY_ASSIGN(SetWords words, words_of(text));
    all.push_back(std::move(words));
  }
  return all;
}

}  // namespace

Result<std::vector<NamedSet>> choose_sets(const CompareArgs& args) {
  RELIEVO_TRY_ASSIGN(auto all, all_words(args));
  if (all.empty()) {
    RELIEVO_TRY_ASSIGN(const auto only, choose_algorithms(args.algorithms));
    all.push_back({only.get("matcher"), {}});
  }
  return make_sets(args.algorithms, all);
}

Result<std::vector<NamedSet>> make_sets(const AlgorithmArgs& algorithms, const std::vector<SetWords>& all) {
  // Algorithms are judged here, not people: a set that makes hardly a face of one is a row with its figures.
  AlgorithmArgs base = algorithms;
  base.settings.insert(base.settings.begin(), "relief=off");
  if (all.size() > kMostSets)
    return Error{Errc::InvalidInput, "sets are too many for one page: at most 64"}.at(
        std::to_string(all.size()));
  std::vector<NamedSet> sets;
  for (const SetWords& words : all) {
    const auto same = [&words](const NamedSet& set) { return set.name == words.name; };
    if (std::any_of(sets.begin(), sets.end(), same))
      return Error{Errc::InvalidInput, "is the name of two sets: give each its own"}.at(words.name);
    RELIEVO_TRY_ASSIGN(NamedSet set, named_set(base, words));
    sets.push_back(std::move(set));
  }
  return sets;
}

}  // namespace relievo::firmware::compare

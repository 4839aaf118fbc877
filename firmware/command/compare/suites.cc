// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/command/compare/suites.h"

#include <algorithm>
#include <array>

#include "pipeline/algorithms.h"

namespace relievo::firmware::compare {
namespace {

using Words = std::vector<SetWords>;

// What a kind may be here.
std::vector<std::string> names_of(std::string_view kind) {
  for (const pipeline::OptionDescription& option : pipeline::describe_algorithms())
    if (option.key == kind) return option.names;
  return {};
}

bool has(std::string_view kind, std::string_view name) {
  const auto names = names_of(kind);
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Every matcher, as it is by default; `file` matches nothing without its file.
Words matchers() {
  Words words;
  for (const std::string& name : names_of("matcher"))
    if (name != "file") words.push_back({name, {"matcher=" + name}});
  return words;
}

// The default matcher without any rule, with each alone, and with all.
Words constraints() {
  Words words{{"no rule", {"constraints=none"}}};
  std::string all;
  for (const std::string& name : names_of("constraints")) {
    if (name == "none") continue;
    words.push_back({name, {"constraints=" + name}});
    all += (all.empty() ? "" : "+") + name;
  }
  words.push_back({"all rules", {"constraints=" + all}});
  return words;
}

Words selectors() {
  Words words;
  for (const std::string& name : names_of("selector"))
    if (name != "file") words.push_back({name, {"selector=" + name}});
  return words;
}

Words preprocessors() {
  Words words;
  for (const std::string& name : names_of("preprocessor")) words.push_back({name, {"preprocessor=" + name}});
  return words;
}

// Bardsley 2004, figures 6 to 12 and 17: sums of squared differences against zero-mean correlation, then the
// constraints one after the other, then all of it; beside them what is the default here.
Words dissertation() {
  Words words;
  const auto add = [&words](std::string name, std::string_view matcher, const std::string& rules) {
    if (has("matcher", matcher)) words.push_back({std::move(name), {"matcher=" + std::string(matcher), "constraints=" + rules}});
  };
  add("SSD", "ssd", "none");
  add("ZMNCC", "zmncc", "none");
  std::string rules;
  for (const std::string_view rule : {"similarity", "uniqueness", "continuity", "ordering", "left-right", "statistical"}) {
    if (!has("constraints", rule)) continue;
    const std::string plus = rules.empty() ? "" : "+";
    rules.append(plus).append(rule);
    add("ZMNCC " + (plus.empty() ? "" : plus + " ") + std::string(rule), "zmncc", rules);
  }
  words.push_back({"Relievo", {}});
  return words;
}

struct Suite {
  std::string_view name;
  Words (*make)();
};
constexpr std::array kSuites{
    Suite{"dissertation", dissertation}, Suite{"matchers", matchers},           Suite{"constraints", constraints},
    Suite{"selectors", selectors},       Suite{"preprocessors", preprocessors},
};

}  // namespace

std::vector<std::string_view> suite_names() {
  std::vector<std::string_view> names;
  for (const Suite& suite : kSuites) names.push_back(suite.name);
  return names;
}

Result<std::vector<SetWords>> suite_sets(std::string_view name) {
  for (const Suite& suite : kSuites)
    if (suite.name == name) return suite.make();
  std::string all;
  for (const Suite& suite : kSuites) all += (all.empty() ? "" : ", ") + std::string(suite.name);
  return Error{Errc::NotFound, "no such suite: choose one of those in brackets"}.at(std::string(name) + " (" + all + ")");
}

}  // namespace relievo::firmware::compare

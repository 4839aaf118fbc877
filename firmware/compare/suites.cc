// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/compare/set_run.h"

#include <algorithm>
#include <array>

#include "firmware/compare/page/compare_page.h"
#include "pipeline/algorithms.h"

namespace relievo::firmware::compare {
namespace {

// "SSD 21: matcher=ssd ssd.window_px=21"
Result<SetWords> words_of(const std::string& text) {
  const std::size_t colon = text.find(':');
  SetWords words;
  words.name = text.substr(0, std::min(colon, text.size()));
  if (colon == std::string::npos || words.name.find_first_not_of(' ') == std::string::npos)
    return invalid("is no set: write \"NAME: KEY=VALUE KEY=VALUE\", as in \"SSD: matcher=ssd\"").at(text);
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

Result<NamedSet> named_set(const AlgorithmArgs& base, const SetWords& words) {
  AlgorithmArgs all = base;
  all.settings.insert(all.settings.end(), words.settings.begin(), words.settings.end());
  const auto set = choose_algorithms(all);
  if (!set) return in_set(set.error(), words.name);
  // Whether it can be made at all: before anything is computed.
  if (const auto made = pipeline::make_algorithms(*set); !made) return in_set(made.error(), words.name);
  return NamedSet{words.name, *set};
}

using Words = std::vector<SetWords>;

// What a kind may be here.
std::vector<std::string> names_of(std::string_view kind) {
  for (const pipeline::OptionDescription& option : pipeline::describe_algorithms())
    if (option.key == kind) return option.names;
  return {};
}

// ZMNCC keeps nothing whose cost is above 0.6 (its min_score), and the rule's own limit stands above that: it
// is for plain skin, which correlates little under noise and is matched right by `refined`. Of what lies
// between, 76 % is wrong on aloe.
constexpr std::string_view kSimilarityLimit = "similarity.max_cost=0.4";

// Each of a kind, as it is by default; those of a file do nothing without it.
Words each_of(const std::string& kind) {
  Words words;
  for (const std::string& name : names_of(kind))
    if (!name.starts_with("file")) words.push_back({name, {kind + "=" + name}});
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
  for (SetWords& set : each_of("selector")) {
    pipeline::AlgorithmSet chosen;
    if (!chosen.set("selector", set.name) || !pipeline::check_neighbours(chosen))
      set.settings.emplace_back("mesher=delaunay");  // which joins scattered points
    words.push_back(std::move(set));
  }
  return words;
}

// What an OpenCV user writes today beside what is ours; the peer's own checks instead of our rules.
Words peers() {
  Words words{{"Relievo", {}}};
  words.push_back({"sgm", {"matcher=sgm"}});
  const std::vector<std::string> peer{"matcher=opencv-sgbm",     "constraints=none",
                                      "opencv-sgbm.window_px=5", "opencv-sgbm.uniqueness=8",
                                      "opencv-sgbm.max_lr_px=1", "opencv-sgbm.speckle_px=200"};
  words.push_back({"OpenCV SGBM 3-way", peer});
  words.back().settings.emplace_back("opencv-sgbm.mode=3way");
  words.push_back({"OpenCV SGBM HH", peer});
  words.back().settings.emplace_back("opencv-sgbm.mode=hh");
  return words;
}

struct Suite {
  std::string_view name;
  Words (*make)();
};
constexpr std::array kSuites{
    Suite{"peers", peers},
    Suite{"matchers", [] { return each_of("matcher"); }},
    Suite{"constraints", constraints},
    Suite{"selectors", selectors},
    Suite{"preprocessors", [] { return each_of("preprocessor"); }},
    Suite{"meshers", [] { return each_of("mesher"); }},
    Suite{"dissertation-face", dissertation_face_sets},
};

Result<std::vector<SetWords>> suite_sets(std::string_view name) {
  for (const Suite& suite : kSuites)
    if (suite.name == name) return suite.make();
  std::string all(kDissertation);
  for (const Suite& suite : kSuites) all += ", " + std::string(suite.name);
  return Error{Errc::NotFound, "no such suite: choose one of those in brackets"}.at(std::string(name) + " (" +
                                                                                    all + ")");
}

Result<std::vector<SetWords>> all_words(const CompareArgs& args) {
  std::vector<SetWords> all;
  for (const std::string& name : args.suites) {
    RELIEVO_TRY_ASSIGN(const auto suite, suite_sets(name));
    all.insert(all.end(), suite.begin(), suite.end());
  }
  for (const Path& file : args.set_files) {
    RELIEVO_TRY_ASSIGN(const auto sets, read_sets_file(file));
    all.insert(all.end(), sets.begin(), sets.end());
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
    return invalid("sets are too many for one page: at most 64").at(std::to_string(all.size()));
  std::vector<NamedSet> sets;
  for (const SetWords& words : all) {
    const auto same = [&words](const NamedSet& set) { return set.name == words.name; };
    if (std::ranges::any_of(sets, same))
      return invalid("is the name of two sets: give each its own").at(words.name);
    RELIEVO_TRY_ASSIGN(NamedSet set, named_set(base, words));
    sets.push_back(std::move(set));
  }
  return sets;
}

std::vector<SetWords> dissertation_rule_sets() {
  Words words;
  const auto add = [&words](std::string name, const std::string& matcher, const std::string& rules) {
    words.push_back(
        {std::move(name),
         {"preprocessor=none", "matcher=" + matcher, "constraints=" + rules, std::string(kSimilarityLimit)}});
  };
  add("SSD", "ssd", "none");
  add("ZMNCC", "zmncc", "none");
  std::string rules;
  for (const std::string_view rule : kDissertationRules) {
    rules.append(rules.empty() ? "" : "+").append(rule);
    add("ZMNCC + " + std::string(rule), "zmncc", rules);
  }
  words.push_back({"Relievo", {}});
  return words;
}

std::vector<SetWords> dissertation_face_sets() {
  std::string rules;
  for (const std::string_view rule : kDissertationRules) rules.append(rules.empty() ? "" : "+").append(rule);
  const std::vector<std::string> chain{"preprocessor=histogram-match",
                                       "matcher=zmncc",
                                       "constraints=" + rules,
                                       std::string(kSimilarityLimit),
                                       "triangulator=linear-least-squares",
                                       "mesher=delaunay",
                                       "texturer=single-view"};
  Words words{{"2004, dense", chain}};
  for (const char* selector : {"good-features", "haar"}) {
    words.push_back({std::string("2004, ") + selector, chain});
    words.back().settings.push_back(std::string("selector=") + selector);
  }
  words.push_back({"Relievo", {}});
  return words;
}

}  // namespace relievo::firmware::compare

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/compare/suites.h"

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

// The six of the dissertation, in its order, as far as they are here.
constexpr std::array<std::string_view, 6> kRules{"similarity", "uniqueness", "continuity",
                                                 "ordering",   "left-right", "statistical"};

// ZMNCC keeps nothing whose cost is above 0.6 (its min_score), and the rule's own limit stands above that: it
// is for plain skin, which correlates little under noise and is matched right by `refined`. Of what lies
// between, 76 % is wrong on aloe.
constexpr std::string_view kSimilarityLimit = "similarity.max_cost=0.4";

std::string all_rules() {
  std::string all;
  for (const std::string_view rule : kRules)
    if (has("constraints", rule)) all += (all.empty() ? "" : "+") + std::string(rule);
  return all.empty() ? "none" : all;
}

// Every matcher, as it is by default; those of a file match nothing without it.
Words matchers() {
  Words words;
  for (const std::string& name : names_of("matcher"))
    if (!name.starts_with("file")) words.push_back({name, {"matcher=" + name}});
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
  for (const std::string& name : names_of("selector")) {
    if (name.starts_with("file")) continue;  // chooses nothing without its file
    words.push_back({name, {"selector=" + name}});
    const bool lattice = name == "dense" || name == "grid-points";
    if (!lattice) words.back().settings.emplace_back("mesher=delaunay");  // which joins scattered points
  }
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
    if (has("matcher", matcher))
      words.push_back({std::move(name),
                       {"preprocessor=none", "matcher=" + std::string(matcher), "constraints=" + rules,
                        std::string(kSimilarityLimit)}});
  };
  add("SSD", "ssd", "none");
  add("ZMNCC", "zmncc", "none");
  std::string rules;
  for (const std::string_view rule : kRules) {
    if (!has("constraints", rule)) continue;
    rules.append(rules.empty() ? "" : "+").append(rule);
    add("ZMNCC + " + std::string(rule), "zmncc", rules);
  }
  words.push_back({"Relievo", {}});
  return words;
}

// Figure 17, the fully automatic face: the chain as it was then, dense and at chosen places, and ours.
Words dissertation_face() {
  std::vector<std::string> chain{"triangulator=linear-least-squares", "mesher=delaunay",
                                 "texturer=single-view"};
  if (has("preprocessor", "histogram-match")) chain.emplace_back("preprocessor=histogram-match");
  if (has("matcher", "zmncc")) chain.emplace_back("matcher=zmncc");
  chain.push_back("constraints=" + all_rules());
  chain.emplace_back(kSimilarityLimit);
  Words words{{"2004, dense", chain}};
  for (const char* selector : {"good-features", "haar"}) {
    if (!has("selector", selector)) continue;
    words.push_back({std::string("2004, ") + selector, chain});
    words.back().settings.push_back(std::string("selector=") + selector);
  }
  words.push_back({"Relievo", {}});
  return words;
}

// What an OpenCV user writes today beside what is ours; the peer's own checks instead of our rules.
Words peers() {
  Words words{{"Relievo", {}}};
  if (has("matcher", "sgm")) words.push_back({"sgm", {"matcher=sgm"}});
  if (!has("matcher", "opencv-sgbm")) return words;
  const std::vector<std::string> peer{"matcher=opencv-sgbm",     "constraints=none",
                                      "opencv-sgbm.window_px=5", "opencv-sgbm.uniqueness=8",
                                      "opencv-sgbm.max_lr_px=1", "opencv-sgbm.speckle_px=200"};
  words.push_back({"OpenCV SGBM 3-way", peer});
  words.back().settings.emplace_back("opencv-sgbm.mode=3way");
  words.push_back({"OpenCV SGBM HH", peer});
  words.back().settings.emplace_back("opencv-sgbm.mode=hh");
  return words;
}

// Every mesher on the same points.
Words meshers() {
  Words words;
  for (const std::string& name : names_of("mesher")) words.push_back({name, {"mesher=" + name}});
  return words;
}

struct Suite {
  std::string_view name;
  Words (*make)();
};
constexpr std::array kSuites{
    Suite{"dissertation", dissertation},
    Suite{"dissertation-face", dissertation_face},
    Suite{"peers", peers},
    Suite{"matchers", matchers},
    Suite{"constraints", constraints},
    Suite{"selectors", selectors},
    Suite{"preprocessors", preprocessors},
    Suite{"meshers", meshers},
};

}  // namespace

std::vector<std::string_view> suite_names() {
  std::vector<std::string_view> names;
  names.reserve(std::size(kSuites));
  for (const Suite& suite : kSuites) names.push_back(suite.name);
  return names;
}

Result<std::vector<SetWords>> suite_sets(std::string_view name) {
  for (const Suite& suite : kSuites)
    if (suite.name == name) return suite.make();
  std::string all;
  for (const Suite& suite : kSuites) all += (all.empty() ? "" : ", ") + std::string(suite.name);
  return Error{Errc::NotFound, "no such suite: choose one of those in brackets"}.at(std::string(name) + " (" +
                                                                                    all + ")");
}

}  // namespace relievo::firmware::compare

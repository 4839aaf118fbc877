// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/algorithms.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>

#include "pipeline/match/constraints/continuity_constraint.h"
#include "pipeline/match/constraints/similarity_constraint.h"
#include "pipeline/match/constraints/uniqueness_constraint.h"
#include "pipeline/match/dense_selector.h"
#include "pipeline/match/refined_matcher.h"
#include "pipeline/mesh/delaunay_mesher.h"
#include "pipeline/mesh/grid_mesher.h"
#include "pipeline/reconstruct/inverse_disparity_triangulator.h"
#include "pipeline/reconstruct/linear_triangulator.h"
#include "pipeline/texture/single_view_texturer.h"
#include "pipeline/texture/two_view_texturer.h"

namespace relievo::pipeline {
namespace {

struct Kind {
  const char* key;
  const char* value;
  const char* sentence;
  std::vector<std::string> names;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      {"selector", "dense", "which places of the left view are matched", {"dense"}},
      {"matcher", "refined", "how their partners in the right view are found", {"refined"}},
      {"constraints", "similarity+uniqueness+continuity", "which rules judge the matches, joined by '+', or none",
       {"similarity", "uniqueness", "continuity", "none"}},
      {"triangulator", "inverse-disparity", "how matches become points", {"inverse-disparity", "linear-least-squares"}},
      {"outliers", "local", "which points are taken for outliers in space", {"local", "none"}},
      {"mesher", "grid", "how points become a surface", {"grid", "delaunay"}},
      {"texturer", "two-view", "how the pictures are laid over it", {"two-view", "single-view"}},
  };
  return all;
}

// Calls visit(section, options) for every algorithm that has options.
template <typename Visit>
void for_each_options(Visit&& visit) {
  visit("dense", DenseSelectorOptions{});
  visit("refined", RefinedMatcherOptions{});
  visit("similarity", SimilarityConstraintOptions{});
  visit("uniqueness", UniquenessConstraintOptions{});
  visit("continuity", ContinuityConstraintOptions{});
  visit("face", FaceCropOptions{});
  visit("local", OutlierFilterOptions{});
  visit("grid", GridMesherOptions{});
  visit("delaunay", DelaunayMesherOptions{});
  visit("two-view", TwoViewTexturerOptions{});
  visit("single-view", SingleViewTexturerOptions{});
}

template <typename Number>
std::string text_of(Number value) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << value;
  return out.str();
}

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t plus = text.find('+');
    parts.emplace_back(text.substr(0, plus));
    if (plus == std::string_view::npos) return parts;
    text.remove_prefix(plus + 1);
  }
}

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

Result<void> check_value(const OptionDescription& option, const std::string& value) {
  const std::string place = option.key + " = " + value;
  if (!option.names.empty()) {
    for (const std::string& part : option.key == "constraints" ? split(value) : std::vector<std::string>{value})
      if (std::find(option.names.begin(), option.names.end(), part) == option.names.end())
        return Error{Errc::NotFound, "no such algorithm: choose one of those in brackets"}.at(place + " (" + joined(option.names) + ")");
    return {};
  }
  char* end = nullptr;
  const double number = std::strtod(value.c_str(), &end);
  if (value.empty() || end != value.c_str() + value.size() || !(number >= option.least && number <= option.most))
    return Error{Errc::InvalidInput, "not a number in the range in brackets"}.at(place + " (" + text_of(option.least) + " to " + text_of(option.most) + ")");
  return {};
}

}  // namespace

// Reads one algorithm's options out of the set.
class AlgorithmMaker {
 public:
  template <typename Options>
  static Result<Options> options(const AlgorithmSet& set, std::string_view section) {
    Options options;
    describe(options, [&](const char* name, auto& value, OptionRange, const char*) {
      const auto chosen = set.chosen_.find(std::string(section) + "." + name);
      if (chosen == set.chosen_.end()) return;
      value = static_cast<std::remove_reference_t<decltype(value)>>(std::strtod(chosen->second.c_str(), nullptr));
    });
    RELIEVO_TRY(options.check());
    return options;
  }
};

namespace {

template <typename Interface, typename Algorithm, typename Options>
Result<std::unique_ptr<Interface>> make(const AlgorithmSet& set, std::string_view section) {
  RELIEVO_TRY_ASSIGN(const Options options, AlgorithmMaker::options<Options>(set, section));
  return std::unique_ptr<Interface>(std::make_unique<Algorithm>(options));
}

const Error kUnknown{Errc::NotFound, "no such algorithm"};

}  // namespace

std::vector<OptionDescription> describe_algorithms() {
  std::vector<OptionDescription> all;
  for (const Kind& kind : kinds()) all.push_back({kind.key, kind.value, kind.sentence, kind.names, 0, 0});
  for_each_options([&](const char* section, auto options) {
    describe(options, [&](const char* name, auto& value, OptionRange range, const char* sentence) {
      all.push_back({std::string(section) + "." + name, text_of(value), sentence, {}, range.least, range.most});
    });
  });
  return all;
}

Result<void> AlgorithmSet::set(std::string_view key, std::string_view value) {
  for (const OptionDescription& option : describe_algorithms())
    if (option.key == key) {
      RELIEVO_TRY(check_value(option, std::string(value)));
      chosen_[std::string(key)] = std::string(value);
      return {};
    }
  return Error{Errc::NotFound, "no such setting: a kind (matcher, mesher, ...) or ALGORITHM.OPTION is expected"}.at(key);
}

std::string AlgorithmSet::get(std::string_view key) const {
  if (const auto chosen = chosen_.find(key); chosen != chosen_.end()) return chosen->second;
  for (const OptionDescription& option : describe_algorithms())
    if (option.key == key) return option.value;
  return {};
}

std::string AlgorithmSet::to_text() const {
  std::map<std::string, std::string, std::less<>> all = chosen_;
  for (const Kind& kind : kinds()) all.try_emplace(kind.key, kind.value);
  std::string text;
  for (const auto& [key, value] : all) {
    text += key;
    text += " = ";
    text += value;
    text += "\n";
  }
  return text;
}

Result<std::unique_ptr<KeypointSelector>> make_selector(const AlgorithmSet& set) {
  const std::string name = set.get("selector");
  if (name == "dense") return make<KeypointSelector, DenseSelector, DenseSelectorOptions>(set, name);
  return kUnknown.at(name);
}

Result<std::unique_ptr<Matcher>> make_matcher(const AlgorithmSet& set) {
  const std::string name = set.get("matcher");
  if (name == "refined") return make<Matcher, RefinedMatcher, RefinedMatcherOptions>(set, name);
  return kUnknown.at(name);
}

Result<std::vector<std::unique_ptr<MatchConstraint>>> make_constraints(const AlgorithmSet& set) {
  std::vector<std::unique_ptr<MatchConstraint>> all;
  for (const std::string& name : split(set.get("constraints"))) {
    if (name == "none") continue;
    auto one = name == "similarity" ? make<MatchConstraint, SimilarityConstraint, SimilarityConstraintOptions>(set, name)
             : name == "uniqueness" ? make<MatchConstraint, UniquenessConstraint, UniquenessConstraintOptions>(set, name)
             : name == "continuity" ? make<MatchConstraint, ContinuityConstraint, ContinuityConstraintOptions>(set, name)
                                    : Result<std::unique_ptr<MatchConstraint>>(kUnknown.at(name));
    if (!one) return one.error();
    all.push_back(*std::move(one));
  }
  return all;
}

Result<std::unique_ptr<Triangulator>> make_triangulator(const AlgorithmSet& set) {
  const std::string name = set.get("triangulator");
  if (name == "inverse-disparity") return std::unique_ptr<Triangulator>(std::make_unique<InverseDisparityTriangulator>());
  if (name == "linear-least-squares") return std::unique_ptr<Triangulator>(std::make_unique<LinearTriangulator>());
  return kUnknown.at(name);
}

Result<std::optional<OutlierFilterOptions>> make_outlier_options(const AlgorithmSet& set) {
  const std::string name = set.get("outliers");
  if (name == "none") return std::optional<OutlierFilterOptions>{};
  if (name != "local") return kUnknown.at(name);
  RELIEVO_TRY_ASSIGN(const OutlierFilterOptions options, AlgorithmMaker::options<OutlierFilterOptions>(set, name));
  return std::optional<OutlierFilterOptions>(options);
}

Result<FaceCropOptions> make_face_crop(const AlgorithmSet& set) {
  return AlgorithmMaker::options<FaceCropOptions>(set, "face");
}

Result<std::unique_ptr<Mesher>> make_mesher(const AlgorithmSet& set) {
  const std::string name = set.get("mesher");
  if (name == "grid") return make<Mesher, GridMesher, GridMesherOptions>(set, name);
  if (name == "delaunay") return make<Mesher, DelaunayMesher, DelaunayMesherOptions>(set, name);
  return kUnknown.at(name);
}

Result<std::unique_ptr<Texturer>> make_texturer(const AlgorithmSet& set) {
  const std::string name = set.get("texturer");
  if (name == "two-view") return make<Texturer, TwoViewTexturer, TwoViewTexturerOptions>(set, name);
  if (name == "single-view") return make<Texturer, SingleViewTexturer, SingleViewTexturerOptions>(set, name);
  return kUnknown.at(name);
}

}  // namespace relievo::pipeline

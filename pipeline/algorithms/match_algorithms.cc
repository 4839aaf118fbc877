// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "pipeline/algorithms/algorithm_table.h"
#include "pipeline/match/coarse/sgm_matcher.h"
#include "pipeline/match/constraints/continuity_constraint.h"
#include "pipeline/match/constraints/left_right_constraint.h"
#include "pipeline/match/constraints/ordering_constraint.h"
#include "pipeline/match/constraints/similarity_constraint.h"
#include "pipeline/match/constraints/statistical_constraint.h"
#include "pipeline/match/constraints/uniqueness_constraint.h"
#include "pipeline/match/file/file_matcher.h"
#include "pipeline/match/peer/sgbm_matcher.h"
#include "pipeline/match/preprocess/highlight_remover.h"
#include "pipeline/match/preprocess/histogram_normaliser.h"
#include "pipeline/match/preprocess/histogram_transfer.h"
#include "pipeline/match/refine/refined_matcher.h"
#include "pipeline/match/select/dense_selector.h"
#include "pipeline/match/select/file_selector.h"
#include "pipeline/match/select/good_features_selector.h"
#include "pipeline/match/select/grid_selector.h"
#include "pipeline/match/select/haar_selector.h"
#include "pipeline/match/select/harris_selector.h"
#include "pipeline/match/select/random_selector.h"
#include "pipeline/match/select/wavelet_salient_selector.h"
#include "pipeline/match/wavelet/wavelet_matcher.h"
#include "pipeline/match/window/ssd_matcher.h"
#include "pipeline/match/window/zmncc_matcher.h"

namespace relievo::pipeline {
namespace {

constexpr std::array kPreprocessors{
    with_options<Preprocessor, HighlightRemover, HighlightRemoverOptions>("remove-highlights"),
    with_options<Preprocessor, HistogramNormaliser, HistogramNormaliserOptions>("histogram-normalise"),
    with_options<Preprocessor, HistogramTransfer, HistogramTransferOptions>("histogram-match"),
};

constexpr std::array kSelectors{
    with_options<KeypointSelector, DenseSelector, DenseSelectorOptions>("dense"),
    with_options<KeypointSelector, GridSelector, GridSelectorOptions>("grid", "grid-points"),
    with_options<KeypointSelector, GoodFeaturesSelector, GoodFeaturesSelectorOptions>("good-features"),
    with_options<KeypointSelector, HarrisSelector, HarrisSelectorOptions>("harris"),
    with_options<KeypointSelector, HaarSelector, HaarSelectorOptions>("haar"),
    with_options<KeypointSelector, WaveletSalientSelector, WaveletSalientSelectorOptions>("wavelet-salient"),
    with_options<KeypointSelector, RandomSelector, RandomSelectorOptions>("random"),
    with_options<KeypointSelector, FileSelector, FileSelectorOptions>("file", "file-points"),
};

constexpr std::array kMatchers{
    with_options<Matcher, RefinedMatcher, RefinedMatcherOptions>("refined"),
    with_options<Matcher, SsdMatcher, SsdMatcherOptions>("ssd"),
    with_options<Matcher, ZmnccMatcher, ZmnccMatcherOptions>("zmncc"),
    with_options<Matcher, WaveletMatcher, WaveletMatcherOptions>("wavelet"),
    with_options<Matcher, SgmMatcher, SgmMatcherOptions>("sgm"),
    with_options<Matcher, SgbmMatcher, SgbmMatcherOptions>("opencv-sgbm"),
    with_options<Matcher, FileMatcher, FileMatcherOptions>("file-matches"),
};

constexpr std::array kConstraints{
    with_options<MatchConstraint, SimilarityConstraint, SimilarityConstraintOptions>("similarity"),
    with_options<MatchConstraint, UniquenessConstraint, UniquenessConstraintOptions>("uniqueness"),
    with_options<MatchConstraint, ContinuityConstraint, ContinuityConstraintOptions>("continuity"),
    with_options<MatchConstraint, OrderingConstraint, OrderingConstraintOptions>("ordering"),
    with_options<MatchConstraint, LeftRightConstraint, LeftRightConstraintOptions>("left-right"),
    with_options<MatchConstraint, StatisticalConstraint, StatisticalConstraintOptions>("statistical"),
};

}  // namespace

std::vector<Kind> match_kinds() {
  std::vector<Kind> kinds{
      kind_of("preprocessor", "remove-highlights", "what is done to the pictures' grey values first", kPreprocessors),
      kind_of("selector", "dense", "which places of the left view are matched", kSelectors),
      kind_of("matcher", "refined", "how their partners in the right view are found", kMatchers),
      kind_of("constraints", "similarity+uniqueness+continuity", "which rules judge the matches, joined by '+', or none", kConstraints),
  };
  kinds.front().names.emplace_back("none");
  kinds.back().names.emplace_back("none");
  kinds.back().several = true;
  return kinds;
}

std::vector<OptionDescription> match_options() {
  std::vector<OptionDescription> all;
  describe_table("preprocessor", kPreprocessors, all);
  describe_table("selector", kSelectors, all);
  describe_table("matcher", kMatchers, all);
  describe_table("constraints", kConstraints, all);
  return all;
}

Result<std::unique_ptr<Preprocessor>> make_preprocessor(const AlgorithmSet& set) {
  const std::string name = set.get("preprocessor");
  if (name == "none") return std::unique_ptr<Preprocessor>();
  return make_named<Preprocessor>(kPreprocessors, set, name);
}

Result<std::unique_ptr<KeypointSelector>> make_selector(const AlgorithmSet& set) {
  return make_named<KeypointSelector>(kSelectors, set, set.get("selector"));
}

Result<std::unique_ptr<Matcher>> make_matcher(const AlgorithmSet& set) {
  return make_named<Matcher>(kMatchers, set, set.get("matcher"));
}

Result<std::vector<std::unique_ptr<MatchConstraint>>> make_constraints(const AlgorithmSet& set) {
  std::vector<std::unique_ptr<MatchConstraint>> all;
  for (const std::string& name : split_names(set.get("constraints"))) {
    if (name == "none") continue;
    auto one = make_named<MatchConstraint>(kConstraints, set, name);
    if (!one) return one.error();
    all.push_back(*std::move(one));
  }
  return all;
}

}  // namespace relievo::pipeline

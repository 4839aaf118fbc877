// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/algorithms/algorithm_table.h"
#include "pipeline/match/coarse/sgm_matcher.h"
#include "pipeline/match/constraints/constraints.h"
#include "pipeline/match/file/file_matcher.h"
#include "pipeline/match/peer/sgbm_matcher.h"
#include "pipeline/match/preprocess/preprocessors.h"
#include "pipeline/match/refine/refined_matcher.h"
#include "pipeline/match/select/selectors.h"
#include "pipeline/match/wavelet/wavelet_matcher.h"
#include "pipeline/match/window/window_matchers.h"

namespace relievo::pipeline {
namespace {

constexpr std::array kPreprocessors{
    algorithm<&HighlightRemover::process>({"remove-highlights",
                                           "takes out what lamps add that oily skin mirrors, by colour",
                                           "Shafer 1985; after Mallick, Zickler, Kriegman, Belhumeur 2005"}),
    algorithm<&HistogramNormaliser::process>(
        {"histogram-normalise", "brings each view to the full range by its own cumulative histogram",
         "Bardsley 2004 (HistNorm); Hummel 1977"}),
    algorithm<&HistogramTransfer::process>({"histogram-match",
                                            "gives the right view the left one's cumulative histogram",
                                            "Bardsley 2004 (HistMatch); Gonzalez and Woods, section 3.3"}),
};

constexpr std::array kSelectors{
    algorithm<&DenseSelector::select>(
        {"dense", "every node of a fine lattice in the face region", "own", true}),
    algorithm<&GridSelector::select>({"grid-points",
                                      "every step of a rectangle that is chosen, in the face region",
                                      "Bardsley 2004 (PatternGrid)", true}),
    algorithm<&GoodFeaturesSelector::select>(
        {"good-features",
         "corners by the smaller eigenvalue of the structure tensor, several thresholds united",
         "Shi and Tomasi 1994; Bardsley 2004 (CvGoodTrackingFeatures)"}),
    algorithm<&HarrisSelector::select>(
        {"harris", "corners by determinant and trace of the structure tensor", "Harris and Stephens 1988"}),
    algorithm<&HaarSelector::select>({"haar", "blobs by box filters on the integral image (Fast-Hessian)",
                                      "Bay, Ess, Tuytelaars, Van Gool 2008 (SURF)"}),
    algorithm<&WaveletSalientSelector::select>({"wavelet-salient",
                                                "ends of the tracks of great wavelet coefficients",
                                                "Loupias, Sebe, Bres, Jolion 2000"}),
    algorithm<&RandomSelector::select>(
        {"random", "different pixels, each equally likely, the same for the same seed: the yardstick",
         "selection sampling, Knuth, The Art of Computer Programming 2, 3.4.2"}),
    algorithm<&FileSelector::select>(
        {"file-points", "points of a text file, x,y a line, as many as there are", "by hand or elsewhere"}),
};

constexpr std::array kMatchers{
    algorithm<&RefinedMatcher::match>(
        {"refined", "one least-squares surface over the whole face, from a coarse semi-global one",
         "own; coarse surface after Hirschmueller 2008", true}),
    algorithm<&SsdMatcher::match>({"ssd", "least sum of squared differences over a square window",
                                   "Anandan 1989; Bardsley 2004, ch. 8", true}),
    algorithm<&ZmnccMatcher::match>({"zmncc",
                                     "greatest zero-mean normalised cross-correlation of a square window",
                                     "Faugeras et al. 1993; Bardsley 2004, ch. 8", true}),
    algorithm<&WaveletMatcher::match>({"wavelet", "coarse-to-fine comparison of dyadic wavelet coefficients",
                                       "after Bhatti and Nahavandi 2008; Bhatti 2011", true}),
    algorithm<&SgmMatcher::match>({"sgm", "semi-global matching on the census transform, coarse to fine",
                                   "Hirschmueller 2008; Rothermel et al. 2012 (tSGM)", true}),
    algorithm<&SgbmMatcher::match>({"opencv-sgbm", "OpenCV's semi-global block matching, to compare with",
                                    "Hirschmueller 2008; cv::StereoSGBM", true}),
    algorithm<&FileMatcher::match>({"file-matches", "matches of a text file, x y disparity [sigma] a line",
                                    "by hand or elsewhere; Bardsley 2004"}),
};

constexpr std::array kConstraints{
    algorithm<&SimilarityConstraint::judge>(
        {"similarity",
         "both views look alike around the match: its cost stays under a limit; after zmncc, whose min_score is a limit too, only one below 1 - min_score says more",
         "Bardsley 2004"}),
    algorithm<&UniquenessConstraint::judge>({"uniqueness", "a place of the right view shows one surface only",
                                             "Marr and Poggio 1976; Bardsley 2004"}),
    algorithm<&ContinuityConstraint::judge>({"continuity",
                                             "on a lattice, disparity varies smoothly nearly everywhere",
                                             "Marr and Poggio 1976; Bardsley 2004"}),
    algorithm<&OrderingConstraint::judge>({"ordering",
                                           "along a row, points keep their order from view to view",
                                           "Yuille and Poggio 1984; Fredman 1975; Bardsley 2004"}),
    algorithm<&LeftRightConstraint::judge>(
        {"left-right", "a match is found again from the right view", "Fua 1993; Bardsley 2004"}),
    algorithm<&StatisticalConstraint::judge>({"statistical",
                                              "a match does not stand out from the others' disparities",
                                              "Bardsley 2004; by median and absolute deviation, Huber 1981"}),
};

}  // namespace

std::vector<Kind> match_kinds() {
  std::vector<Kind> kinds{
      kind_of("preprocessor", "remove-highlights", "what is done to the pictures' grey values first",
              kPreprocessors),
      kind_of("selector", "dense", "which places of the left view are matched", kSelectors),
      kind_of("matcher", "refined", "how their partners in the right view are found", kMatchers),
      kind_of("constraints", "similarity+uniqueness+continuity",
              "which rules judge the matches, joined by '+', or none", kConstraints),
  };
  kinds.front().algorithms.push_back({"none", "the grey values stay", "own"});
  kinds.back().algorithms.push_back({"none", "every match is taken", "own"});
  kinds.back().several = true;
  return kinds;
}

Result<Preprocessor> make_preprocessor(const AlgorithmSet& set) {
  return make_named(kPreprocessors, set, set.get("preprocessor"));
}

Result<KeypointSelector> make_selector(const AlgorithmSet& set) {
  return make_named(kSelectors, set, set.get("selector"));
}

Result<Matcher> make_matcher(const AlgorithmSet& set) {
  return make_named(kMatchers, set, set.get("matcher"));
}

Result<std::vector<MatchConstraint>> make_constraints(const AlgorithmSet& set) {
  std::vector<MatchConstraint> all;
  for (const std::string& name : split_names(set.get("constraints"))) {
    if (name == "none") continue;
    RELIEVO_TRY_ASSIGN(all.emplace_back(), make_named(kConstraints, set, name));
  }
  return all;
}

}  // namespace relievo::pipeline

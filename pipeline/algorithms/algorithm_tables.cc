// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/algorithms.h"

#include <algorithm>
#include <array>
#include <functional>
#include <type_traits>
#include <utility>

#include "pipeline/fuse/head_fuser.h"
#include "pipeline/match/coarse/sgm_matcher.h"
#include "pipeline/match/constraints/constraints.h"
#include "pipeline/match/file/file_matcher.h"
#include "pipeline/match/peer/sgbm_matcher.h"
#include "pipeline/match/preprocess/preprocessors.h"
#include "pipeline/match/refine/refined_matcher.h"
#include "pipeline/match/select/selectors.h"
#include "pipeline/match/wavelet/wavelet_matcher.h"
#include "pipeline/match/window/window_matchers.h"
#include "pipeline/mesh/completion/completions.h"
#include "pipeline/mesh/meshers/grid_mesher.h"
#include "pipeline/mesh/meshers/scattered_meshers.h"
#include "pipeline/reconstruct/outlier_filters.h"
#include "pipeline/reconstruct/triangulators.h"
#include "pipeline/texture/texturers.h"

// The tables of algorithms: one line an algorithm, `algorithm<&SsdMatcher::match>({name, what it is,
// source})`, is all that its name on the command line, its options, their documentation and its making need.
namespace relievo::pipeline {

// What may be chosen, kind by kind.
struct Catalogue {
  std::vector<OptionDescription> kinds, options;

  template <typename Table>
  void add(const char* key, const char* value, const char* sentence, const Table& table) {
    kinds.push_back({key, value, sentence});
    for (const auto& algorithm : table) {
      offer(algorithm.about);
      algorithm.describe(*this, algorithm.about.name);
    }
  }
  // One more of the last kind.
  void offer(const AlgorithmDescription& about) {
    kinds.back().names.emplace_back(about.name);
    kinds.back().algorithms.push_back(about);
  }
  // The options of one algorithm of the last kind, as they are by default.
  template <typename Options>
  void describe_options(std::string_view section) {
    Options defaults;
    describe(defaults, [&](const char* name, auto& value, const OptionRange& range, const char* sentence) {
      using Value = std::remove_reference_t<decltype(value)>;
      OptionDescription& one = options.emplace_back();
      one.key = std::string(section) + "." + name;
      one.value = option_text(value, range);
      one.sentence = sentence;
      one.names.assign(range.names.begin(), range.names.end());
      one.range = range_of<Value>(range);
      one.file = std::is_same_v<Value, TextFile>;
      one.text = one.file || std::is_same_v<Value, std::string>;
      one.kind = kinds.back().key;
    });
  }
};

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
      else value = static_cast<Value>(*number_in(chosen->second));
    });
    RELIEVO_TRY(check_options(options, section));
    return options;
  }
};

template <typename Form>  // one of the kinds: a std::function
struct Algorithm {
  AlgorithmDescription about;
  Result<Form> (*make)(const AlgorithmSet& set, std::string_view section);
  void (*describe)(Catalogue& all, std::string_view section);
};

template <auto kRun, typename Options, typename Returned, typename... Taken>
constexpr auto algorithm(const AlgorithmDescription& about, Returned (Options::*)(Taken...) const) {
  using Form = std::function<Returned(Taken...)>;
  return Algorithm<Form>{
      about,
      [](const AlgorithmSet& set, std::string_view section) -> Result<Form> {
        RELIEVO_TRY_ASSIGN(const Options options, OptionReader::read<Options>(set, section));
        return Form(std::bind_front(kRun, options));
      },
      [](Catalogue& all, std::string_view section) { all.describe_options<Options>(section); }};
}

template <auto kRun>
constexpr auto algorithm(const AlgorithmDescription& about) {
  return algorithm<kRun>(about, kRun);
}

// "none", which is in no table, makes an empty function.
template <typename Form, std::size_t kCount>
Result<Form> make_named(const std::array<Algorithm<Form>, kCount>& table, const AlgorithmSet& set,
                        std::string_view name) {
  for (const Algorithm<Form>& algorithm : table)
    if (name == algorithm.about.name) return algorithm.make(set, name);
  return Form();
}

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

constexpr std::array kTriangulators{
    algorithm<&InverseDisparityTriangulator::triangulate>(
        {"inverse-disparity", "depth is focal length times baseline over disparity",
         "the pinhole camera's geometry"}),
    algorithm<&LinearTriangulator::triangulate>(
        {"linear-least-squares", "the point nearest to both lines of sight", "Bardsley 2004, ch. 9"}),
    algorithm<&OptimalTriangulator::triangulate>(
        {"optimal", "the point whose images are nearest to what was seen", "Lindstrom 2010 (niter2)"}),
};

constexpr std::array kOutlierFilters{
    algorithm<&LocalOutlierFilter::reject>({"local",
                                            "takes flying points, spikes and islands, by their neighbours",
                                            "Bardsley 2004 (NoOutliers); own"}),
    algorithm<&StatisticalOutlierFilter::reject>(
        {"statistical", "a point's mean distance to its neighbours is not much beyond the cloud's",
         "Rusu et al. 2008"}),
};

constexpr std::array kMeshers{
    algorithm<&GridMesher::mesh>(
        {"grid", "joins neighbours of the lattice and closes the face to its outline; needs a lattice", "own",
         true}),
    algorithm<&DelaunayMesher::mesh>(
        {"delaunay", "2.5-D Delaunay triangulation over the left view; takes scattered points",
         "Bardsley 2004; CGAL"}),
    algorithm<&AdvancingFrontMesher::mesh>(
        {"advancing-front", "grown over the 3-D Delaunay triangulation, the most plausible triangle first",
         "Cohen-Steiner and Da 2004; CGAL"}),
    algorithm<&PoissonMesher::mesh>({"poisson",
                                     "the surface whose inside's gradient follows the points' normals",
                                     "Kazhdan et al. 2006; CGAL"}),
    algorithm<&RbfMesher::mesh>(
        {"rbf", "one thin-plate function with greedily chosen centres", "Carr et al. 2001"}),
    algorithm<&MarchingCubesMesher::mesh>({"marching-cubes", "zero surface of implicit moving least squares",
                                           "Kolluri 2008; Lorensen and Cline 1987"}),
    algorithm<&BezierMesher::mesh>(
        {"bezier", "a C1 net of bicubic patches, fitted by least squares", "Farin 2002; Dierckx 1993"}),
};

constexpr std::array kCompletions{
    algorithm<&MeasuredOnly::complete>({"measured-only", "nothing is added", "own"}),
    algorithm<&SymmetricCompletion::complete>(
        {"symmetric", "what one side hides is mirrored from the other", "own"}),
    algorithm<&GenericHeadCompletion::complete>(
        {"generic-head", "the usual head fitted to what was measured stands where nothing was", "own"}),
};

constexpr std::array kTexturers{
    algorithm<&TwoViewTexturer::texture>(
        {"two-view", "both photographs, each where it sees the surface straighter", "own"}),
    algorithm<&SingleViewTexturer::texture>({"single-view", "the left photograph alone", "Bardsley 2004"}),
};

}  // namespace

std::vector<OptionDescription> describe_algorithms() {
  Catalogue all;
  all.add("preprocessor", "remove-highlights", "what is done to the pictures' grey values first",
          kPreprocessors);
  all.offer({"none", "the grey values stay", "own"});
  all.add("selector", "dense", "which places of the left view are matched", kSelectors);
  all.add("matcher", "refined", "how their partners in the right view are found", kMatchers);
  all.add("constraints", "similarity+uniqueness+continuity",
          "which rules judge the matches, joined by '+', or none", kConstraints);
  all.offer({"none", "every match is taken", "own"});
  all.kinds.back().several = true;
  all.add("triangulator", "inverse-disparity", "how matches become points", kTriangulators);
  all.describe_options<FaceCropOptions>("face");
  all.add("outliers", "local", "which points are taken for outliers in space", kOutlierFilters);
  all.offer({"none", "every point is taken", "own"});
  all.add("mesher", "grid", "how points become a surface", kMeshers);
  all.add("completion", "measured-only", "what is made of surface that was not seen", kCompletions);
  all.kinds.push_back({"relief", "check", "whether a picture of a face is told from a face and refused"});
  all.offer({"check", "a sheet, however it is bent, is no face", "Gauss 1827; own"});
  all.offer({"off", "pictures of faces pass", "own"});
  all.describe_options<ReliefOptions>("relief");
  all.add("texturer", "two-view", "how the pictures are laid over it", kTexturers);
  all.kinds.push_back({"fuser", "averaged", "how several pairs of a head that turned become one surface"});
  all.offer(
      {"averaged", "the mean where they agree, the first pair's where they do not", "Kolluri 2008; own"});
  all.describe_options<HeadFuser>("averaged");
  all.kinds.insert(all.kinds.end(), all.options.begin(), all.options.end());
  return std::move(all.kinds);
}

Result<Algorithms> make_algorithms(const AlgorithmSet& set) {
  Algorithms made;
  RELIEVO_TRY_ASSIGN(made.preprocessor, make_named(kPreprocessors, set, set.get("preprocessor")));
  RELIEVO_TRY_ASSIGN(made.selector, make_named(kSelectors, set, set.get("selector")));
  RELIEVO_TRY_ASSIGN(made.matcher, make_named(kMatchers, set, set.get("matcher")));
  for (const std::string& name : split_names(set.get("constraints"))) {
    if (name == "none") continue;
    RELIEVO_TRY_ASSIGN(made.constraints.emplace_back(), make_named(kConstraints, set, name));
  }
  RELIEVO_TRY_ASSIGN(made.triangulator, make_named(kTriangulators, set, set.get("triangulator")));
  RELIEVO_TRY_ASSIGN(made.crop, OptionReader::read<FaceCropOptions>(set, "face"));
  RELIEVO_TRY_ASSIGN(made.outliers, make_named(kOutlierFilters, set, set.get("outliers")));
  RELIEVO_TRY_ASSIGN(made.mesher, make_named(kMeshers, set, set.get("mesher")));
  RELIEVO_TRY_ASSIGN(made.completion, make_named(kCompletions, set, set.get("completion")));
  if (set.get("relief") != "off") {
    RELIEVO_TRY_ASSIGN(made.relief, OptionReader::read<ReliefOptions>(set, "relief"));
  }
  RELIEVO_TRY_ASSIGN(made.texturer, make_named(kTexturers, set, set.get("texturer")));
  return made;
}

Result<HeadFuser> make_head_fuser(const AlgorithmSet& set) {
  return OptionReader::read<HeadFuser>(set, "averaged");
}

}  // namespace relievo::pipeline

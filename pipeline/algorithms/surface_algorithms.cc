// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "pipeline/algorithms/algorithm_table.h"
#include "pipeline/fuse/head_fuser.h"
#include "pipeline/mesh/completion/generic_head_completion.h"
#include "pipeline/mesh/completion/measured_only.h"
#include "pipeline/mesh/completion/symmetric_completion.h"
#include "pipeline/mesh/meshers/advancing_front_mesher.h"
#include "pipeline/mesh/meshers/bezier_mesher.h"
#include "pipeline/mesh/meshers/delaunay_mesher.h"
#include "pipeline/mesh/meshers/grid_mesher.h"
#include "pipeline/mesh/meshers/marching_cubes_mesher.h"
#include "pipeline/mesh/meshers/poisson_mesher.h"
#include "pipeline/mesh/meshers/rbf_mesher.h"
#include "pipeline/reconstruct/inverse_disparity_triangulator.h"
#include "pipeline/reconstruct/linear_triangulator.h"
#include "pipeline/reconstruct/local_outlier_filter.h"
#include "pipeline/reconstruct/optimal_triangulator.h"
#include "pipeline/reconstruct/statistical_outlier_filter.h"
#include "pipeline/texture/single_view_texturer.h"
#include "pipeline/texture/two_view_texturer.h"

namespace relievo::pipeline {
namespace {

constexpr std::array kTriangulators{
    without_options<Triangulator, InverseDisparityTriangulator>(
        {"inverse-disparity", "depth is focal length times baseline over disparity",
         "the pinhole camera's geometry"}),
    without_options<Triangulator, LinearTriangulator>(
        {"linear-least-squares", "the point nearest to both lines of sight", "Bardsley 2004, ch. 9"}),
    without_options<Triangulator, OptimalTriangulator>(
        {"optimal", "the point whose images are nearest to what was seen", "Lindstrom 2010 (niter2)"}),
};

constexpr std::array kOutlierFilters{
    with_options<OutlierFilter, LocalOutlierFilter, LocalOutlierFilterOptions>(
        {"local", "takes flying points, spikes and islands, by their neighbours",
         "Bardsley 2004 (NoOutliers); own"}),
    with_options<OutlierFilter, StatisticalOutlierFilter, StatisticalOutlierFilterOptions>(
        {"statistical", "a point's mean distance to its neighbours is not much beyond the cloud's",
         "Rusu et al. 2008"}),
};

constexpr std::array kMeshers{
    with_options<Mesher, GridMesher, GridMesherOptions>(
        {"grid", "joins neighbours of the lattice and closes the face to its outline; needs a lattice",
         "own"}),
    with_options<Mesher, DelaunayMesher, DelaunayMesherOptions>(
        {"delaunay", "2.5-D Delaunay triangulation over the left view; takes scattered points",
         "Bardsley 2004; CGAL"}),
    with_options<Mesher, AdvancingFrontMesher, AdvancingFrontMesherOptions>(
        {"advancing-front", "grown over the 3-D Delaunay triangulation, the most plausible triangle first",
         "Cohen-Steiner and Da 2004; CGAL"}),
    with_options<Mesher, PoissonMesher, PoissonMesherOptions>(
        {"poisson", "the surface whose inside's gradient follows the points' normals",
         "Kazhdan et al. 2006; CGAL"}),
    with_options<Mesher, RbfMesher, RbfMesherOptions>(
        {"rbf", "one thin-plate function with greedily chosen centres", "Carr et al. 2001"}),
    with_options<Mesher, MarchingCubesMesher, MarchingCubesMesherOptions>(
        {"marching-cubes", "zero surface of implicit moving least squares",
         "Kolluri 2008; Lorensen and Cline 1987"}),
    with_options<Mesher, BezierMesher, BezierMesherOptions>(
        {"bezier", "a C1 net of bicubic patches, fitted by least squares", "Farin 2002; Dierckx 1993"}),
};

constexpr std::array kCompletions{
    without_options<Completion, MeasuredOnly>({"measured-only", "nothing is added", "own"}),
    with_options<Completion, SymmetricCompletion, SymmetricCompletionOptions>(
        {"symmetric", "what one side hides is mirrored from the other", "own"}),
    with_options<Completion, GenericHeadCompletion, GenericHeadOptions>(
        {"generic-head", "the usual head fitted to what was measured stands where nothing was", "own"}),
};

constexpr std::array kTexturers{
    with_options<Texturer, TwoViewTexturer, TwoViewTexturerOptions>(
        {"two-view", "both photographs, each where it sees the surface straighter", "own"}),
    with_options<Texturer, SingleViewTexturer, SingleViewTexturerOptions>(
        {"single-view", "the left photograph alone", "Bardsley 2004"}),
};

}  // namespace

std::vector<Kind> surface_kinds() {
  std::vector<Kind> kinds{
      kind_of("triangulator", "inverse-disparity", "how matches become points", kTriangulators),
      kind_of("outliers", "local", "which points are taken for outliers in space", kOutlierFilters),
      kind_of("mesher", "grid", "how points become a surface", kMeshers),
      kind_of("completion", "measured-only", "what is made of surface that was not seen", kCompletions),
      {"relief",
       "check",
       "whether a picture of a face is told from a face and refused",
       {{"check", "a sheet, however it is bent, is no face", "Gauss 1827; own"},
        {"off", "pictures of faces pass", "own"}}},
      kind_of("texturer", "two-view", "how the pictures are laid over it", kTexturers),
      {"fuser",
       "averaged",
       "how several pairs of a head that turned become one surface",
       {{"averaged", "the mean where they agree, the first pair's where they do not", "Kolluri 2008; own"}}},
  };
  kinds[1].algorithms.push_back({"none", "every point is taken", "own"});
  return kinds;
}

std::vector<OptionDescription> surface_options() {
  std::vector<OptionDescription> all;
  describe_table("triangulator", kTriangulators, all);
  describe_options<FaceCropOptions>("triangulator", "face", all);
  describe_table("outliers", kOutlierFilters, all);
  describe_table("mesher", kMeshers, all);
  describe_table("completion", kCompletions, all);
  describe_options<ReliefOptions>("relief", "relief", all);
  describe_table("texturer", kTexturers, all);
  describe_options<HeadFuserOptions>("fuser", "averaged", all);
  return all;
}

Result<std::unique_ptr<Triangulator>> make_triangulator(const AlgorithmSet& set) {
  return make_named<Triangulator>(kTriangulators, set, set.get("triangulator"));
}

Result<std::unique_ptr<OutlierFilter>> make_outlier_filter(const AlgorithmSet& set) {
  const std::string name = set.get("outliers");
  if (name == "none") return std::unique_ptr<OutlierFilter>();
  return make_named<OutlierFilter>(kOutlierFilters, set, name);
}

Result<FaceCropOptions> make_face_crop(const AlgorithmSet& set) {
  return OptionReader::read<FaceCropOptions>(set, "face");
}

Result<std::unique_ptr<Mesher>> make_mesher(const AlgorithmSet& set) {
  return make_named<Mesher>(kMeshers, set, set.get("mesher"));
}

Result<std::unique_ptr<Completion>> make_completion(const AlgorithmSet& set) {
  return make_named<Completion>(kCompletions, set, set.get("completion"));
}

Result<std::optional<ReliefOptions>> make_relief_check(const AlgorithmSet& set) {
  if (set.get("relief") == "off") return std::optional<ReliefOptions>();
  RELIEVO_TRY_ASSIGN(const ReliefOptions options, OptionReader::read<ReliefOptions>(set, "relief"));
  return std::optional(options);
}

Result<HeadFuserOptions> make_head_fuser(const AlgorithmSet& set) {
  return OptionReader::read<HeadFuserOptions>(set, "averaged");
}

Result<std::unique_ptr<Texturer>> make_texturer(const AlgorithmSet& set) {
  return make_named<Texturer>(kTexturers, set, set.get("texturer"));
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/algorithms/algorithm_table.h"
#include "pipeline/fuse/head_fuser.h"
#include "pipeline/mesh/completion/completions.h"
#include "pipeline/mesh/meshers/grid_mesher.h"
#include "pipeline/mesh/meshers/scattered_meshers.h"
#include "pipeline/reconstruct/outlier_filters.h"
#include "pipeline/reconstruct/triangulators.h"
#include "pipeline/texture/texturers.h"

namespace relievo::pipeline {
namespace {

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
  describe_options<FaceCropOptions>("face", kinds[0]);
  kinds[1].algorithms.push_back({"none", "every point is taken", "own"});
  describe_options<ReliefOptions>("relief", kinds[4]);
  describe_options<HeadFuser>("averaged", kinds[6]);
  return kinds;
}

Result<Triangulator> make_triangulator(const AlgorithmSet& set) {
  return make_named(kTriangulators, set, set.get("triangulator"));
}

Result<OutlierFilter> make_outlier_filter(const AlgorithmSet& set) {
  return make_named(kOutlierFilters, set, set.get("outliers"));
}

Result<FaceCropOptions> make_face_crop(const AlgorithmSet& set) {
  return OptionReader::read<FaceCropOptions>(set, "face");
}

Result<Mesher> make_mesher(const AlgorithmSet& set) { return make_named(kMeshers, set, set.get("mesher")); }

Result<Completion> make_completion(const AlgorithmSet& set) {
  return make_named(kCompletions, set, set.get("completion"));
}

Result<std::optional<ReliefOptions>> make_relief_check(const AlgorithmSet& set) {
  if (set.get("relief") == "off") return std::optional<ReliefOptions>();
  RELIEVO_TRY_ASSIGN(const ReliefOptions options, OptionReader::read<ReliefOptions>(set, "relief"));
  return std::optional(options);
}

Result<HeadFuser> make_head_fuser(const AlgorithmSet& set) {
  return OptionReader::read<HeadFuser>(set, "averaged");
}

Result<Texturer> make_texturer(const AlgorithmSet& set) {
  return make_named(kTexturers, set, set.get("texturer"));
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "pipeline/algorithms/algorithm_table.h"
#include "pipeline/mesh/catalogue/advancing_front_mesher.h"
#include "pipeline/mesh/catalogue/bezier_mesher.h"
#include "pipeline/mesh/catalogue/marching_cubes_mesher.h"
#include "pipeline/mesh/catalogue/poisson_mesher.h"
#include "pipeline/mesh/catalogue/rbf_mesher.h"
#include "pipeline/mesh/completion/measured_only.h"
#include "pipeline/mesh/completion/generic_head_completion.h"
#include "pipeline/mesh/completion/symmetric_completion.h"
#include "pipeline/mesh/delaunay_mesher.h"
#include "pipeline/mesh/grid_mesher.h"
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
    without_options<Triangulator, InverseDisparityTriangulator>("inverse-disparity"),
    without_options<Triangulator, LinearTriangulator>("linear-least-squares"),
    without_options<Triangulator, OptimalTriangulator>("optimal"),
};

constexpr std::array kOutlierFilters{
    with_options<OutlierFilter, LocalOutlierFilter, LocalOutlierFilterOptions>("local"),
    with_options<OutlierFilter, StatisticalOutlierFilter, StatisticalOutlierFilterOptions>("statistical"),
};

constexpr std::array kMeshers{
    with_options<Mesher, GridMesher, GridMesherOptions>("grid"),
    with_options<Mesher, DelaunayMesher, DelaunayMesherOptions>("delaunay"),
    with_options<Mesher, AdvancingFrontMesher, AdvancingFrontMesherOptions>("advancing-front"),
    with_options<Mesher, PoissonMesher, PoissonMesherOptions>("poisson"),
    with_options<Mesher, RbfMesher, RbfMesherOptions>("rbf"),
    with_options<Mesher, MarchingCubesMesher, MarchingCubesMesherOptions>("marching-cubes"),
    with_options<Mesher, BezierMesher, BezierMesherOptions>("bezier"),
};

constexpr std::array kCompletions{
    without_options<Completion, MeasuredOnly>("measured-only"),
    with_options<Completion, SymmetricCompletion, SymmetricCompletionOptions>("symmetric"),
    with_options<Completion, GenericHeadCompletion, GenericHeadOptions>("generic-head"),
};

constexpr std::array kTexturers{
    with_options<Texturer, TwoViewTexturer, TwoViewTexturerOptions>("two-view"),
    with_options<Texturer, SingleViewTexturer, SingleViewTexturerOptions>("single-view"),
};

}  // namespace

std::vector<Kind> surface_kinds() {
  std::vector<Kind> kinds{
      kind_of("triangulator", "inverse-disparity", "how matches become points", kTriangulators),
      kind_of("outliers", "local", "which points are taken for outliers in space", kOutlierFilters),
      kind_of("mesher", "grid", "how points become a surface", kMeshers),
      kind_of("completion", "measured-only", "what is made of surface that was not seen", kCompletions),
      {"relief", "check", "whether a picture of a face is told from a face and refused", {"check", "off"}},
      kind_of("texturer", "two-view", "how the pictures are laid over it", kTexturers),
  };
  kinds[1].names.emplace_back("none");
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

Result<std::unique_ptr<Texturer>> make_texturer(const AlgorithmSet& set) {
  return make_named<Texturer>(kTexturers, set, set.get("texturer"));
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "pipeline/algorithms/algorithm_table.h"
#include "pipeline/mesh/delaunay_mesher.h"
#include "pipeline/mesh/grid_mesher.h"
#include "pipeline/reconstruct/inverse_disparity_triangulator.h"
#include "pipeline/reconstruct/linear_triangulator.h"
#include "pipeline/reconstruct/optimal_triangulator.h"
#include "pipeline/texture/single_view_texturer.h"
#include "pipeline/texture/two_view_texturer.h"

namespace relievo::pipeline {
namespace {

constexpr std::array kTriangulators{
    without_options<Triangulator, InverseDisparityTriangulator>("inverse-disparity"),
    without_options<Triangulator, LinearTriangulator>("linear-least-squares"),
    without_options<Triangulator, OptimalTriangulator>("optimal"),
};

constexpr std::array kMeshers{
    with_options<Mesher, GridMesher, GridMesherOptions>("grid"),
    with_options<Mesher, DelaunayMesher, DelaunayMesherOptions>("delaunay"),
};

constexpr std::array kTexturers{
    with_options<Texturer, TwoViewTexturer, TwoViewTexturerOptions>("two-view"),
    with_options<Texturer, SingleViewTexturer, SingleViewTexturerOptions>("single-view"),
};

}  // namespace

std::vector<Kind> surface_kinds() {
  return {
      kind_of("triangulator", "inverse-disparity", "how matches become points", kTriangulators),
      {"outliers", "local", "which points are taken for outliers in space", {"local", "none"}},
      kind_of("mesher", "grid", "how points become a surface", kMeshers),
      kind_of("texturer", "two-view", "how the pictures are laid over it", kTexturers),
  };
}

std::vector<OptionDescription> surface_options() {
  std::vector<OptionDescription> all;
  describe_table(kTriangulators, all);
  describe_options<FaceCropOptions>("face", all);
  describe_options<OutlierFilterOptions>("local", all);
  describe_table(kMeshers, all);
  describe_table(kTexturers, all);
  return all;
}

Result<std::unique_ptr<Triangulator>> make_triangulator(const AlgorithmSet& set) {
  return make_named<Triangulator>(kTriangulators, set, set.get("triangulator"));
}

Result<std::optional<OutlierFilterOptions>> make_outlier_options(const AlgorithmSet& set) {
  if (set.get("outliers") == "none") return std::optional<OutlierFilterOptions>{};
  RELIEVO_TRY_ASSIGN(const OutlierFilterOptions options, OptionReader::read<OutlierFilterOptions>(set, "local"));
  return std::optional<OutlierFilterOptions>(options);
}

Result<FaceCropOptions> make_face_crop(const AlgorithmSet& set) {
  return OptionReader::read<FaceCropOptions>(set, "face");
}

Result<std::unique_ptr<Mesher>> make_mesher(const AlgorithmSet& set) {
  return make_named<Mesher>(kMeshers, set, set.get("mesher"));
}

Result<std::unique_ptr<Texturer>> make_texturer(const AlgorithmSet& set) {
  return make_named<Texturer>(kTexturers, set, set.get("texturer"));
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/meshers/scattered_meshers.h"

#include <algorithm>

#include "pipeline/mesh/meshers/band_volume.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr float kLeastSigmaMm = 0.005F;
constexpr float kBetweenShare = 0.05F;  // of a measured point's weight, where there is none near
constexpr float kSparse = 1.5F;         // voxels: points further apart are joined by others

// Those of a sheet, by their certainty.
void add_points(const FaceMesh& sheet, float share, std::pmr::vector<FieldPoint>& points) {
  for (std::size_t i = 0; i < sheet.vertices_mm.size(); ++i) {
    const float sigma = std::max(sheet.sigma_mm[i], kLeastSigmaMm);
    points.push_back(
        {sheet.vertices_mm[i], sheet.normals[i], share * kLeastSigmaMm * kLeastSigmaMm / (sigma * sigma)});
  }
}

}  // namespace

Result<FaceMesh> MarchingCubesMesher::mesh(const PointCloud& cloud, StageContext& context) const {
  if (context.stop()) return Error{Errc::Cancelled, "meshing was stopped"};
  RELIEVO_TRY_ASSIGN(const FaceMesh base, base_sheet(cloud, max_points, context));
  // Points wide apart would leave holes between their balls: the voxels follow.
  const float voxel = std::max(float(voxel_mm), 0.6F * usual_edge_mm(base, &context.scratch));
  const float radius = float(band_voxels) * voxel;
  BandVolume volume = volume_around(base.vertices_mm, voxel, int(band_voxels) + 2, &context.scratch);
  const FaceMesh between = densify(base, kSparse * voxel, &context.scratch);
  std::pmr::vector<FieldPoint> points(&context.scratch);
  points.reserve(base.vertices_mm.size() + between.vertices_mm.size());
  add_points(base, 1, points);
  add_points(between, kBetweenShare, points);
  fill_field(points, radius, volume, context);
  if (context.stop()) return Error{Errc::Cancelled, "meshing was stopped"};
  Polygonised surface = polygonise(volume, &context.scratch);
  return finish_surface(base, surface.vertices_mm, surface.triangles, finish, context);
}

}  // namespace relievo::pipeline

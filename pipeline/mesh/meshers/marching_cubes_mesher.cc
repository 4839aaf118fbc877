// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/meshers/marching_cubes_mesher.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "pipeline/mesh/meshers/band_volume.h"
#include "pipeline/mesh/vector_math.h"

namespace relievo::pipeline {
namespace {

constexpr float kLeastSigmaMm = 0.005F;
constexpr float kBetweenShare = 0.05F;  // of a measured point's weight, where there is none near
constexpr float kSparse = 1.5F;         // voxels: points further apart are joined by others

// Adds the points' planes to values and weights of the field.
void splat(const FaceMesh& points, float share, float radius, BandVolume& volume, std::span<float> weight) {
  const float narrow = 1 / (2 * volume.voxel_mm * volume.voxel_mm);
  for (std::size_t i = 0; i < points.vertices_mm.size(); ++i) {
    const Vec3f& p = points.vertices_mm[i];
    const float sigma = std::max(points.sigma_mm[i], kLeastSigmaMm);
    const float sure = share * kLeastSigmaMm * kLeastSigmaMm / (sigma * sigma);
    for_each_voxel_near(volume, p, radius, [&](int x, int y, int z) {
      const Vec3f from = mesh::minus(volume.at(x, y, z), p);
      const float w = sure * std::exp(-narrow * mesh::dot(from, from));
      const std::size_t k = volume.index(x, y, z);
      volume.value[k] += w * mesh::dot(from, points.normals[i]);
      weight[k] += w;
    });
  }
}

void fill_field(const FaceMesh& base, const FaceMesh& between, float radius, BandVolume& volume,
                std::pmr::memory_resource* memory) {
  std::pmr::vector<float> weight(volume.value.size(), 0.0F, memory);
  std::fill(volume.value.begin(), volume.value.end(), 0.0F);
  splat(base, 1, radius, volume, weight);
  splat(between, kBetweenShare, radius, volume, weight);
  for (std::size_t k = 0; k < weight.size(); ++k)
    volume.value[k] = weight[k] > 0 ? std::clamp(volume.value[k] / weight[k], -radius, radius)
                                    : std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

Result<void> MarchingCubesMesherOptions::check() const {
  if (max_points < 1000 || max_points > 1'000'000)
    return Error{Errc::InvalidInput, "max_points must lie in 1000 .. 1000000"}.at("mesher.marching-cubes");
  if (!(voxel_mm >= 0.3 && voxel_mm <= 10) || !(band_voxels >= 1.8 && band_voxels <= 5))
    return Error{Errc::InvalidInput, "voxel_mm 0.3 .. 10, band_voxels 1.8 .. 5"}.at("mesher.marching-cubes");
  return finish.check("mesher.marching-cubes");
}

Result<FaceMesh> MarchingCubesMesher::mesh(const PointCloud& cloud, StageContext& context) const {
  RELIEVO_TRY(options_.check());
  if (context.stop()) return Error{Errc::Cancelled, "meshing was stopped"};
  RELIEVO_TRY_ASSIGN(const FaceMesh base, base_sheet(cloud, options_.max_points, context));
  // Points wide apart would leave holes between their balls: the voxels follow.
  const float voxel =
      std::max(static_cast<float>(options_.voxel_mm), 0.6F * usual_edge_mm(base, &context.scratch));
  const float radius = static_cast<float>(options_.band_voxels) * voxel;
  BandVolume volume =
      volume_around(base.vertices_mm, voxel, static_cast<int>(options_.band_voxels) + 2, &context.scratch);
  fill_field(base, densify(base, kSparse * voxel, &context.scratch), radius, volume, &context.scratch);
  if (context.stop()) return Error{Errc::Cancelled, "meshing was stopped"};
  Polygonised surface = polygonise(volume, &context.scratch);
  return finish_surface(base, surface.vertices_mm, surface.triangles, options_.finish, context);
}

}  // namespace relievo::pipeline

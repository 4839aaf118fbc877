// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Poisson_reconstruction_function.h>
#include <CGAL/property_map.h>

#include "pipeline/mesh/meshers/band_volume.h"
#include "pipeline/mesh/meshers/scattered_meshers.h"

namespace relievo::pipeline {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Oriented = std::pair<Kernel::Point_3, Kernel::Vector_3>;

constexpr double kBackMm = 60;
constexpr std::size_t kBackStride = 8;
constexpr int kSmoothings = 3;
constexpr float kSparse = 1.5F;  // voxels: the band joins points further apart

// Positive outside, at the voxels of the band. False where it was stopped or could not be solved.
bool fill_field(const FaceMesh& base, BandVolume& volume, float radius, StageContext& context) {
  std::vector<Oriented> points;
  points.reserve(base.vertices_mm.size() + base.vertices_mm.size() / kBackStride + 1);
  const auto d = [](float v) { return double(v); };
  for (std::size_t i = 0; i < base.vertices_mm.size(); ++i) {
    const Vec3f &p = base.vertices_mm[i], &n = base.normals[i];
    points.emplace_back(Kernel::Point_3(d(p.x), d(p.y), d(p.z)), Kernel::Vector_3(d(n.x), d(n.y), d(n.z)));
    // A face is an open sheet, and a flat one has no volume to refine: a coarse back, far behind, closes it.
    if (i % kBackStride != 0) continue;
    const double distance = std::sqrt(d(p.x) * d(p.x) + d(p.y) * d(p.y) + d(p.z) * d(p.z));
    const Kernel::Vector_3 away(d(p.x) / distance, d(p.y) / distance, d(p.z) / distance);
    points.emplace_back(Kernel::Point_3(d(p.x), d(p.y), d(p.z)) + kBackMm * away, away);
  }
  CGAL::Poisson_reconstruction_function<Kernel> inside(points.begin(), points.end(),
                                                       CGAL::First_of_pair_property_map<Oriented>(),
                                                       CGAL::Second_of_pair_property_map<Oriented>());
  if (context.stop() || !inside.compute_implicit_function()) return false;
  constexpr float kWanted = -1;  // marks the band, until its values are known
  const FaceMesh between = densify(base, kSparse * volume.voxel_mm, &context.scratch);
  for (const auto* near : {&base.vertices_mm, &between.vertices_mm})
    for (const Vec3f& p : *near)
      for_each_voxel_near(volume, p, radius,
                          [&](int x, int y, int z) { volume.value[volume.index(x, y, z)] = kWanted; });
  for (int z = 0; z < volume.nz && !context.stop(); ++z)
    for (int y = 0; y < volume.ny; ++y)
      for (int x = 0; x < volume.nx; ++x) {
        float& value = volume.value[volume.index(x, y, z)];
        if (std::isnan(value)) continue;
        const Vec3f at = volume.at(x, y, z);
        value = float(inside(Kernel::Point_3(d(at.x), d(at.y), d(at.z))));
        if (!std::isfinite(value)) value = std::numeric_limits<float>::quiet_NaN();
      }
  return !context.stop();
}

// One pass of 1 2 1 along one direction, over what is known. CGAL's function is linear from vertex to vertex
// of its triangulation: left alone, the surface shows its facets.
void smooth(BandVolume& volume, std::size_t stride, std::pmr::memory_resource* memory) {
  const std::pmr::vector<float> before(volume.value, memory);
  for (std::size_t k = stride; k + stride < before.size(); ++k) {
    if (std::isnan(before[k])) continue;
    const float low = before[k - stride], high = before[k + stride];
    if (!std::isnan(low) && !std::isnan(high)) volume.value[k] = (low + 2 * before[k] + high) / 4;
  }
}

}  // namespace

Result<FaceMesh> PoissonMesher::mesh(const PointCloud& cloud, StageContext& context) const {
  const Error stopped{Errc::Cancelled, "meshing was stopped"};
  if (context.stop()) return stopped;
  RELIEVO_TRY_ASSIGN(const FaceMesh base, base_sheet(cloud, max_points, context));
  const float voxel = std::max(float(voxel_mm), 0.6F * usual_edge_mm(base, &context.scratch));
  BandVolume volume = volume_around(base.vertices_mm, voxel, int(band_voxels) + 2, &context.scratch);
  if (!fill_field(base, volume, float(band_voxels) * voxel, context))
    return context.stop() ? stopped : no_surface();
  const std::size_t row = std::size_t(volume.nx);
  for (int pass = 0; pass < kSmoothings; ++pass)
    for (const std::size_t stride : {std::size_t{1}, row, row * std::size_t(volume.ny)}) {
      const Arena::Mark line(context.scratch);
      smooth(volume, stride, &context.scratch);
    }
  Polygonised surface = polygonise(volume, &context.scratch);
  return finish_surface(base, surface.vertices_mm, surface.triangles, finish, context);
}

}  // namespace relievo::pipeline

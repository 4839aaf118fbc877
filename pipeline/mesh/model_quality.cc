// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/model_quality.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace relievo::pipeline {
namespace {

// The front of the face: a disc around the tip of the nose, looked at from straight ahead.
constexpr double kFrontRadiusMm = 60;
constexpr double kCellMm = 2;
constexpr int kCells = 2 * static_cast<int>(kFrontRadiusMm / kCellMm) + 1;

double triangle_area(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const double vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
  return 0.5 * std::sqrt(nx * nx + ny * ny + nz * nz);
}

double front_coverage(const FaceMesh& mesh, const HeadFrame& frame, Arena& scratch) {
  Arena::Mark mark(scratch);
  std::pmr::vector<std::uint8_t> seen(static_cast<std::size_t>(kCells * kCells), 0, &scratch);
  for (std::size_t k = 0; k < mesh.vertices_mm.size(); ++k) {
    if (mesh.measured[k] == 0) continue;
    const Vec3f& v = mesh.vertices_mm[k];
    const Vec3d p = apply(frame.head_from_camera, {v.x, v.y, v.z});
    if (std::hypot(p.x, p.y) > kFrontRadiusMm) continue;
    const int i = static_cast<int>(std::lround((p.x + kFrontRadiusMm) / kCellMm));
    const int j = static_cast<int>(std::lround((p.y + kFrontRadiusMm) / kCellMm));
    seen[static_cast<std::size_t>(std::clamp(j, 0, kCells - 1) * kCells + std::clamp(i, 0, kCells - 1))] = 1;
  }
  int inside = 0;
  int covered = 0;
  for (int j = 0; j < kCells; ++j)
    for (int i = 0; i < kCells; ++i) {
      if (std::hypot(i * kCellMm - kFrontRadiusMm, j * kCellMm - kFrontRadiusMm) > kFrontRadiusMm - kCellMm) continue;
      ++inside;
      covered += seen[static_cast<std::size_t>(j * kCells + i)];
    }
  return static_cast<double>(covered) / inside;
}

double median_sigma(const FaceMesh& mesh, Arena& scratch) {
  Arena::Mark mark(scratch);
  std::pmr::vector<float> sigma(&scratch);
  sigma.reserve(mesh.sigma_mm.size());
  for (std::size_t k = 0; k < mesh.sigma_mm.size(); ++k)
    if (mesh.measured[k] != 0) sigma.push_back(mesh.sigma_mm[k]);
  if (sigma.empty()) return 0;
  const auto middle = sigma.begin() + static_cast<std::ptrdiff_t>(sigma.size() / 2);
  std::nth_element(sigma.begin(), middle, sigma.end());
  return static_cast<double>(*middle);
}

}  // namespace

ModelQuality measure_quality(const FaceMesh& mesh, const HeadFrame& frame, StageContext& context) {
  ModelQuality quality;
  for (const auto& t : mesh.triangles)
    if (mesh.measured[t[0]] != 0 && mesh.measured[t[1]] != 0 && mesh.measured[t[2]] != 0)
      quality.measured_area_mm2 += triangle_area(mesh.vertices_mm[t[0]], mesh.vertices_mm[t[1]], mesh.vertices_mm[t[2]]);
  quality.median_sigma_mm = median_sigma(mesh, context.scratch);
  quality.coverage = front_coverage(mesh, frame, context.scratch);
  quality.width_mm = frame.width_mm;
  quality.height_mm = frame.height_mm;
  quality.nose_relief_mm = frame.nose_relief_mm;
  quality.symmetry_residual_mm = frame.asymmetry_mm;
  return quality;
}

}  // namespace relievo::pipeline

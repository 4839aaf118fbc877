// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The plane in which a surface mirrors itself best: reflect the surface, register the reflection to
// the surface point to plane, robustly, as in ICP (cf. Combes, Hennessy, Waddington, Roberts, Prima,
// CVPR 2008). Half a face against the other half, never a template.
#pragma once

#include <memory_resource>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "pipeline/base/stage.h"

namespace relievo::pipeline {

struct SurfacePoint {
  Eigen::Vector3d at_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

// Means of a surface over square cells of its own x-y plane, seen along z.
class HeightMap {
 public:
  HeightMap(std::span<const SurfacePoint> points, double cell_mm, std::pmr::memory_resource* memory);
  // The cell's mean point below or above (x, y); null where the surface has none.
  const SurfacePoint* at(double x_mm, double y_mm) const;

 private:
  double cell_mm_;
  double left_mm_ = 0, bottom_mm_ = 0;
  int columns_ = 0, rows_ = 0;
  std::pmr::vector<SurfacePoint> cells_;
  std::pmr::vector<std::uint32_t> count_;
};

struct SymmetryPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  // unit length, pointing to +x
  double offset_mm = 0;                               // normal . p = offset
  double cost_mm = 0;      // mean capped distance, missing surface included: to compare planes
  double residual_mm = 0;  // median distance of the reflected surface to the surface
  double overlap = 0;      // share of the surface whose reflection meets surface
};

// `points` in a frame whose z axis looks roughly out of the face, whose x axis runs roughly across it
// (within about 40 degrees of yaw, 20 of roll) and whose origin lies within about 10 mm of the plane,
// as the tip of a nose does. Errors: PoorGeometry, Cancelled.
Result<SymmetryPlane> find_symmetry_plane(std::span<const SurfacePoint> points, StageContext& context);

// The plane of symmetry nearest to x = 0, which must be near: its normal and offset alone. Memory: scratch.
SymmetryPlane settle_symmetry_plane(std::span<const SurfacePoint> points, Arena& scratch);

}  // namespace relievo::pipeline

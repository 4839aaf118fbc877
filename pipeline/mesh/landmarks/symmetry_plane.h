// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The plane in which a surface mirrors itself best: reflect the surface, register the reflection to
// the surface point to plane, robustly, as in ICP (cf. Combes, Hennessy, Waddington, Roberts, Prima,
// CVPR 2008). Half a face against the other half, never a template.
#pragma once

#include <span>

#include <Eigen/Core>

#include "pipeline/base/stage.h"

namespace relievo::pipeline {

struct SurfacePoint {
  Eigen::Vector3d at_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

struct SymmetryPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  // unit length, pointing to +x
  double offset_mm = 0;                               // normal . p = offset
  double cost_mm = 0;      // mean capped distance, missing surface included: to compare planes
  double residual_mm = 0;  // median distance of the reflected surface to the surface
};

// `points` in a frame whose z axis looks roughly out of the face, whose x axis runs roughly across it
// (within about 40 degrees of yaw, 20 of roll) and whose origin lies within about 10 mm of the plane,
// as the tip of a nose does. Errors: PoorGeometry, Cancelled.
Result<SymmetryPlane> find_symmetry_plane(std::span<const SurfacePoint> points, StageContext& context);

// The plane of symmetry nearest to x = 0, which must be near: its normal and offset alone. Memory: scratch.
SymmetryPlane settle_symmetry_plane(std::span<const SurfacePoint> points, Arena& scratch);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mesher: points to one connected, consistently oriented surface with normals.
// Errors: PoorGeometry (no surface of a face's size), InvalidInput (it needs more triangles than allowed),
// OutOfMemory, Cancelled.
#pragma once

#include <functional>

#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/point_cloud.h"

namespace relievo::pipeline {

// What is less certain along the line of sight (a chin that moved between the exposures, hair) is surface,
// but not measured: whichever mesher ran, a head's frame and its landmarks are found on the same.
inline constexpr double kMeasuredSigmaMm = 0.75;

using Mesher = std::function<Result<FaceMesh>(const PointCloud& cloud, StageContext& context)>;

// Completion: gives a measured surface what the cameras did not see. Completed vertices carry measured = 0
// and a sigma_mm of their own; what was measured stays bit for bit where it is. One connected manifold
// surface comes out. A surface in which no head is found, or to which nothing can be added, comes back as it
// is. Errors: OutOfMemory, Cancelled. `across`: which way runs across the person, as find_head_frame() wants
// it.
using Completion = std::function<Result<FaceMesh>(FaceMesh mesh, const Vec3d& across, StageContext& context)>;

}  // namespace relievo::pipeline

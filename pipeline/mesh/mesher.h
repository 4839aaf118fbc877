// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mesher: points to one connected, consistently oriented surface with normals.
// Errors: PoorGeometry (no surface of a face's size), OutOfMemory, Cancelled.
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

}  // namespace relievo::pipeline

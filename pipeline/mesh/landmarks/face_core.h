// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The core of a face: what cameras see of it however it turns, beside the nose, below and above the eyes.
// From it, how the face nods and where the tip of its nose lies, both robust to what highlights pull away and
// to a side that is hidden. What was completed counts for the tip alone. Memory: scratch only, given back.
// No errors but std::bad_alloc; thread: any.
#pragma once

#include <Eigen/Core>

#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct FaceCore {
  double nod_rad = 0;  // how much brow and cheeks lean back beyond an upright head's
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();  // mm, on the plane of symmetry, x = 0
};

// `head_from_camera`: a frame near the head's, x across the face, z out of it, the origin near the tip.
FaceCore face_core(const FaceMesh& mesh, const RigidTransform& head_from_camera, StageContext& context);

}  // namespace relievo::pipeline

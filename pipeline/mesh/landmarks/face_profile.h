// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The face's profile: where its plane of symmetry cuts it, and the points that anatomy names on it.
// Nasion and subnasale are what lies deepest below the profile's convex hull, so that they do not depend on
// how the head nods; tip, nasion's depth and chin are extremes along z, so that their depth does so only in
// second order. A chin of which nothing is foremost is where a line from the tip of the nose touches it (the
// line of Ricketts 1968).
// Millimetres, in a frame with x = 0 on the plane of symmetry, y up, z out of the face. Thread: any.
#pragma once

#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "pipeline/base/stage.h"
#include "pipeline/mesh/landmarks/face_relief.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

// The core of a face: what cameras see of it however it turns, beside the nose, below and above the eyes.
// From it, how the face nods and where the tip of its nose lies, both robust to what highlights pull away and
// to a side that is hidden. What was completed counts for the tip alone. Memory: scratch only, given back.
// No errors but std::bad_alloc; thread: any.
struct FaceCore {
  double nod_rad = 0;  // how much brow and cheeks lean back beyond an upright head's
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();  // mm, on the plane of symmetry, x = 0
};

// `head_from_camera`: a frame near the head's, x across the face, z out of it, the origin near the tip.
FaceCore face_core(const FaceMesh& mesh, const RigidTransform& head_from_camera, StageContext& context);

struct ProfilePoint {
  double y_mm = 0, z_mm = 0;
};

// From the chin upwards; gaps are left out. Both sides of the nose count, or the one that was seen. Of the
// measured surface, unless `completed_too`.
std::pmr::vector<ProfilePoint> profile_of(const FaceMesh& mesh, const RigidTransform& frame_from_mesh,
                                          std::pmr::memory_resource* memory, bool completed_too = false);

struct ProfileMarks {
  std::optional<ProfilePoint> tip, nasion, subnasale, chin;
  bool chin_recedes = false;  // it is where that line touches it
};

// `profile` in a frame whose origin lies within about 15 mm of the tip.
ProfileMarks find_profile_marks(std::span<const ProfilePoint> profile);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the same skin lies in two poses, by their photographs: shape alone hardly tells whether a head slid
// along its own surface. A window on one surface is found on the other one (Lucas, Kanade 1981), first at
// half the resolution; light that differs evenly does not matter. Thread: any. No memory is allocated.
#pragma once

#include <array>
#include <optional>

#include "pipeline/fuse/head_pose.h"

namespace relievo::pipeline {

// Whether a pixel is narrow enough to show skin.
bool shows_skin(const HeadPose& pose, const Vec3d& place_mm);

// Where the other pose's photograph shows what `pose` shows at `place_mm`, each in its own frame. `along`:
// two directions along the surface, unit length, in the frame of `pose`. None where the other does not show
// it, or not alike.
std::optional<Vec3d> same_skin(const HeadPose& pose, const Vec3d& place_mm, const std::array<Vec3d, 2>& along,
                               const HeadPose& other, const RigidTransform& other_from_pose);

}  // namespace relievo::pipeline

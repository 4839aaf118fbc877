// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Skin that moved between the pictures: every pose after the first is bent along its normals to the surfaces
// before it. Thread: any.
#pragma once

#include <span>

#include "pipeline/fuse/pose_registration.h"

namespace relievo::pipeline {

struct BendLimits {
  double most_mm = 0;   // skin that would have to move further is not shown by that pose
  double width_mm = 0;  // sigma of the Gaussian that smooths the displacement
  double still_mm = 0;  // below this it is not bent
  // Behind the temples, where no other pose shows it, skin is held where it is: it hangs on the skull and
  // does not move as the face beside it. Not where the poses' calibrations differ: then it may be off as a
  // whole.
  bool skull_stays = false;
};

// One after the other: the first never moves, and next is always the pose that overlaps most with those that
// are done. Its sigma grows by a share of how far the skin around was bent. Memory: scratch. Throws
// std::bad_alloc.
void bend_to_master(std::span<HeadPose> poses, const Registration& registration, const BendLimits& limits,
                    StageContext& context);

}  // namespace relievo::pipeline

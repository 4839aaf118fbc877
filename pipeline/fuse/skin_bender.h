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
  // Where no other pose shows it, what hangs on the skull is not bent as the face beside it: not so where
  // calibrations differ.
  bool skull_stays = false;
};

// In the order in which they overlap what was fixed before them; the first never moves. Where a pose was bent
// by d its sigma grows by a part of d. Memory: scratch. Throws std::bad_alloc.
void bend_to_master(std::span<PoseSurface> poses, const Registration& registration, const BendLimits& limits,
                    StageContext& context);

}  // namespace relievo::pipeline

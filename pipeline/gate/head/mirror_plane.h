// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The plane in which the points of a relief mirror themselves best, looked for near an upright one through
// `tip`. Thread: any; deterministic. Errors: none.
#pragma once

#include <array>
#include <span>

#include "pipeline/model/relief.h"

namespace relievo::pipeline {

// Right, down and away of a head that faces the middle between the cameras from where it is.
struct HeadAxes {
  Vec3d right, down, away;
};
HeadAxes axes_facing_the_rig(const Vec3d& at, double baseline_mm);

struct MirrorPlane {
  double yaw_deg = 0, roll_deg = 0,
         offset_mm = 0;  // signs: head_measurement.h; offset along the normal, from the tip
  double rms_mm = 0;     // of the points against the relief behind their mirror images
  double price = 0;      // the same, more for a head that leans: of two planes the cheaper one is the head's
};
Vec3d normal_of(const MirrorPlane& plane, const HeadAxes& axes);  // to the picture's right

// The best of three ranges of yaw: turned to the picture's left, straight, to its right. A cheek alone
// mirrors itself about its own middle as well as a whole face does: which of the three is the head's, the
// nose must tell. `points` within about 80 mm of the tip, 60 or more.
std::array<MirrorPlane, 3> find_mirror_planes(const Relief& relief, std::span<const Vec3d> points,
                                              const Vec3d& tip, const HeadAxes& axes, double limit_mm);

}  // namespace relievo::pipeline

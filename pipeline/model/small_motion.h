// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a step of a rigid registration does: turns about a pivot by a rotation vector (radians; Rodrigues),
// then moves. All in one frame, millimetres. Thread: any.
#pragma once

#include <cmath>

#include "pipeline/model/vector3.h"

namespace relievo::pipeline {

inline RigidTransform small_motion(const Vec3d& turn_rad, const Vec3d& shift_mm, const Vec3d& pivot_mm) {
  RigidTransform out;
  if (const double angle = length(turn_rad); angle > 1e-12) {
    const Vec3d a = times(turn_rad, 1 / angle), s = times(a, std::sin(angle));
    const double c = std::cos(angle);
    const Vec3d k = times(a, 1 - c);
    out.rotation = {{k.x * a.x + c, k.x * a.y - s.z, k.x * a.z + s.y, k.x * a.y + s.z, k.y * a.y + c,
                     k.y * a.z - s.x, k.x * a.z - s.y, k.y * a.z + s.x, k.z * a.z + c}};
  }
  out.translation_mm = plus(minus(pivot_mm, apply(out.rotation, pivot_mm)), shift_mm);
  return out;
}

}  // namespace relievo::pipeline

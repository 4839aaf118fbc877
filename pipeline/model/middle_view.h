// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// MiddleView: a camera half way between the two, rectified as they are. What both see is in one piece there and turns
// away from it least; what one alone sees has half of its width.
#pragma once

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct MiddleView {
  Rotation rectified_from_left;  // axes of both rectified views, of the left camera's
  double focal_px = 0;           // 0: there are no two views
  Vec2d centre_px;               // columns count from the mean of both windows' columns
  Vec3d at_mm;                   // where it stands, in the left camera's frame

  bool exists() const { return focal_px > 0; }
  // Where it sees a point given from its own place, along the left camera's axes. z must lie before it.
  Vec2d project(const Vec3d& from_here_mm) const {
    const Vec3d p = apply(rectified_from_left, from_here_mm);
    return {centre_px.x + focal_px * p.x / p.z, centre_px.y + focal_px * p.y / p.z};
  }
};

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ViewEdge: an edge as the camera at the origin sees it: how far it leads along the line of sight and how far
// across. Their ratio is the surface's slope in that direction.
#pragma once

#include <algorithm>
#include <cmath>

#include "pipeline/model/vector3.h"

namespace relievo::pipeline::mesh {

struct ViewEdge {
  float depth_mm, across_mm;
};

inline ViewEdge edge_between(const Vec3f& from, const Vec3f& to) {
  const Vec3f e = minus(to, from);
  const Vec3f sight = unit(plus(from, to));
  const float depth = dot(e, sight);
  return {depth, std::sqrt(std::max(dot(e, e) - depth * depth, 1e-12F))};
}

}  // namespace relievo::pipeline::mesh

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Takes slivers out of a surface: a triangle with an angle below the bar gives its longest edge to a flip,
// its shortest edge to a collapse, or goes where it hangs on the border by its longest edge (the local
// operations of Freitag, Ollivier-Gooch 1997, without moving any vertex). No change makes a worse angle,
// turns a triangle away from the camera or beyond `max_slope`, makes an edge of three triangles, or adds
// a triangle. Deterministic. Thread: any.
#pragma once

#include <cstddef>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/mesh/surface_cleaner.h"

namespace relievo::pipeline {

// The angle below which a triangle is a sliver: what the steepest surface that is shown makes of a
// lattice's right-angled triangles (77 degrees: 12.7) stays above it.
inline constexpr float kSmallestAngleDeg = 10;

struct SliverLimits {
  float smallest_angle_deg = kSmallestAngleDeg;
  float max_slope = 0;  // tangent of the steepest angle of incidence
};

// `triangles` must be one manifold surface. Vertices may be left without triangles. Returns how many slivers
// nothing helped; those that touched the border are gone, and what they held together may have come apart:
// above 0 the surface must be cleaned again (keep_one_surface). Throws std::bad_alloc when `scratch` is used
// up.
std::size_t mend_slivers(std::span<const Vec3f> vertices_mm, std::pmr::vector<Triangle>& triangles,
                         const SliverLimits& limits, std::pmr::memory_resource* scratch);

// The smallest of the three angles, degrees.
float smallest_angle_deg(const Vec3f& a, const Vec3f& b, const Vec3f& c);

}  // namespace relievo::pipeline

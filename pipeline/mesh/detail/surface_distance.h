// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far points lie from a surface of triangles: the exact distance to its nearest point, found through
// cells over the picture plane. Points and surface lie in front of the camera at the origin. Millimetres.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct SurfaceDistance {
  double rms_mm = 0;
  double max_mm = 0;
};

// Zero for no points. Throws std::bad_alloc when `memory` is used up.
SurfaceDistance distance_to_surface(std::span<const Vec3f> points_mm, std::span<const Vec3f> vertices_mm,
                                    std::span<const std::array<std::uint32_t, 3>> triangles,
                                    std::pmr::memory_resource* memory);

// Squared, of a point to a triangle.
double squared_distance_to_triangle(const Vec3f& p, const Vec3f& a, const Vec3f& b, const Vec3f& c);

}  // namespace relievo::pipeline

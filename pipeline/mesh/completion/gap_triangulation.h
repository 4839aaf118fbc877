// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Joins points beside a surface to its border: a constrained Delaunay triangulation in a plane onto which
// both are laid. Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

// `border`: directed edges of the surface's boundary as its own triangles run, which lie on the left of them
// in the plane. `plane` holds a place for every vertex; `added` names those that belong to no triangle yet.
// Returns triangles outside the surface, counter-clockwise, in a fixed order: each with an added vertex; or,
// where `far_point` is given, notches of the border up to 8 wide, too, and what lies beyond the convex hull
// runs to that vertex.
std::pmr::vector<std::array<std::uint32_t, 3>> triangulate_gap(
    std::span<const Vec2f> plane, std::span<const std::array<std::uint32_t, 2>> border,
    std::span<const std::uint32_t> added, std::optional<std::uint32_t> far_point,
    std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Joins points beside a surface to its border: a constrained Delaunay triangulation in a plane onto which
// both are laid. Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

// `border`: directed edges of the surface's boundary as its own triangles run, which lie on the left of them
// in the plane. `plane` holds a place for every vertex; `added` names those that belong to no triangle yet.
// Returns triangles outside the surface, counter-clockwise, each with an added vertex, in a fixed order.
std::pmr::vector<std::array<std::uint32_t, 3>> triangulate_gap(
    std::span<const Vec2f> plane, std::span<const std::array<std::uint32_t, 2>> border,
    std::span<const std::uint32_t> added, std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline

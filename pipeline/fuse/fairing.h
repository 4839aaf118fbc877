// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lays parts of a surface anew as thin plates that go on from all sides: what closes a hole, and the steps
// where one pose's surface ends and another one's, or what was completed, goes on a fraction of a millimetre
// beside it. Thread: any. Throw std::bad_alloc.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/mesh/surface_cleaner.h"

namespace relievo::pipeline {

// One a vertex, as long as twice the area of the triangles around it.
std::pmr::vector<Vec3f> area_normals(std::span<const Vec3f> vertices_mm, std::span<const Triangle> triangles,
                                     std::pmr::memory_resource* memory);

inline constexpr std::uint8_t kBetweenNothing = 255;  // label of a vertex beside which no step is looked for

// Adds the steps to `part`, one byte a vertex, for `fair_part`. A step is a triangle between different
// `label`s (one a vertex: who says where it lies) that stands at more than 21 degrees to the surface beside
// it.
void add_steps(std::span<const Vec3f> vertices_mm, std::span<const Triangle> triangles,
               std::span<const std::uint8_t> label, std::span<std::uint8_t> part,
               std::pmr::memory_resource* memory);

// Adds the folds to `part`: triangles of `unsure` vertices that stand at more than 40 degrees to the surface
// a few vertices around them. Skin has none that small.
void add_folds(std::span<const Vec3f> vertices_mm, std::span<const Triangle> triangles,
               std::span<const std::uint8_t> unsure, std::span<std::uint8_t> part,
               std::pmr::memory_resource* memory);

// A vertex with n gives each of its neighbours at least n - 1, and so on.
void spread_rings(std::span<const Triangle> triangles, std::span<std::uint8_t> rings);

// Lays anew the vertices with `part` above 0, and around one with n those up to n - 1 edges away; vertices
// with `stays` 1 are left. No two come to lie on one place. Returns by how much each vertex moved along the
// normal, millimetres. Memory: `memory`, and the heap for what is laid anew.
std::pmr::vector<float> fair_part(std::span<Vec3f> vertices_mm, std::span<const Triangle> triangles,
                                  std::span<const std::uint8_t> part, std::span<const std::uint8_t> stays,
                                  std::pmr::memory_resource* memory);

// Triangles that are turned over against those around them: their vertices, but for those of rims, go to the
// middle of their neighbours until none is, or it leads nowhere.
void unfold(std::span<Vec3f> vertices_mm, std::span<const Triangle> triangles,
            std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rims of a fused head's surface: cut even (rim.cc), its holes closed (cgal_hole_filler.cc), and parts of
// it laid anew as thin plates that go on from all sides (fairing.cc): what closes a hole, and the steps where
// one pose's surface ends and another one's, or what was completed, goes on a fraction of a millimetre beside
// it. Triangles are counter-clockwise seen from outside; no rim passes through a vertex twice, nor two
// (keep_one_surface()). Thread: any. Throw std::bad_alloc.
#pragma once

#include <cstdint>
#include <functional>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/mesh/surface_cleaner.h"

namespace relievo::pipeline {

// Takes away what no disc of that radius within the surface covers: teeth, threads, corners (an opening;
// Serra 1982). Vertices with `sure` 1, one byte a vertex, stay, and what lies that near to them; but a part
// that is joined to the rest by fewer than `holds` vertices that are sure goes all the same.
void open_rims(std::span<const Vec3f> vertices_mm, std::span<const std::uint8_t> sure,
               std::pmr::vector<Triangle>& triangles, float radius_mm, int holds,
               std::pmr::memory_resource* memory);

// Straightens rims: every vertex of them towards the middle of its two neighbours, by at most so much from
// where it was.
void smooth_rims(std::span<Vec3f> vertices_mm, std::span<const BorderEdge> border, int rounds, float most_mm,
                 std::pmr::memory_resource* memory);

// Two vertices that came to lie on one place would join sheets there: the second goes back to where it began,
// `started`. Memory: `memory`.
void part_equals(std::span<Vec3f> vertices_mm, std::span<const Vec3f> started,
                 std::pmr::memory_resource* memory);

struct HoleLimits {
  float rim_mm;                                 // a hole's length around, at most
  std::function<float(const Vec3f&)> mouth_mm;  // of a bay of the longest rim, by its headlands, at most
};

struct ClosedHoles {
  std::vector<std::uint32_t> beside;     // for each new vertex one of the rim that it closes
  std::vector<std::uint32_t> left_open;  // vertices of rims short enough that could not be closed
};

// Closes every hole but the longest rim, and that one's bays from headland to headland, along a curve that
// leaves both as the surface does: by the triangulation of least area (Barequet, Sharir 1995), refined to the
// rim's own density (Liepa 2003; both CGAL). One whose closing would use an edge that is there already stays
// open. `normals`: outwards, any length, one a vertex. New vertices and triangles stand at the end; every new
// triangle has a new vertex.
ClosedHoles close_holes(std::pmr::vector<Vec3f>& vertices_mm, std::span<const Vec3f> normals,
                        std::span<const BorderEdge> border, const HoleLimits& limits,
                        std::pmr::vector<Triangle>& triangles);

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
// middle of their neighbours until none is, later with their neighbours, or it leads nowhere.
void unfold(std::span<Vec3f> vertices_mm, std::span<const Triangle> triangles,
            std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sews what a completion added to what was measured: a constrained Delaunay triangulation of the gap between
// them, laid flat. What was measured stays bit for bit where it is. Memory: the mesh in `output`, the rest in
// scratch; CGAL's triangulation of the gap takes from the heap. Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct Addition {
  Vec3f at_mm;  // the left camera's frame
  Vec2f plane;
  float sigma_mm;
};

struct SewingRules {
  double longest_edge_mm;               // wider gaps stay open
  std::optional<Addition> far_point{};  // of a whole head: what all of the plane's far edge runs to
  double faired_mm = 0;  // so far from the seam what was added is laid anew, to go on without a crease
};

// `flat`: where each vertex of `mesh` lies when laid flat, x and y, seen from outside. No addition may lie
// where the mesh does. Throws std::bad_alloc.
FaceMesh sew(const FaceMesh& mesh, std::span<const Vec3f> flat, std::span<const Addition> added,
             const SewingRules& rules, StageContext& context);

// Joins points beside a surface to its border: a constrained Delaunay triangulation in a plane onto which
// both are laid. `border`: directed edges of the surface's boundary as its own triangles run, which lie on
// the left of them in the plane. `plane` holds a place for every vertex; `added` names those that belong to
// no triangle yet. Returns triangles outside the surface, counter-clockwise, in a fixed order: each with an
// added vertex; or, where `far_point` is given, notches of the border up to 8 wide, too, and what lies beyond
// the convex hull runs to that vertex.
std::pmr::vector<Triangle> triangulate_gap(std::span<const Vec2f> plane,
                                           std::span<const std::array<std::uint32_t, 2>> border,
                                           std::span<const std::uint32_t> added,
                                           std::optional<std::uint32_t> far_point,
                                           std::pmr::memory_resource* memory);

// Closes every hole: one of three edges by a triangle, a larger one by a fan about a vertex in its middle.
void fan_holes(FaceMesh& mesh, Arena& scratch);

}  // namespace relievo::pipeline

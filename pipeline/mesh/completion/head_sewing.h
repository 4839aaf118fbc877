// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sews what a completion added to what was measured: a constrained Delaunay triangulation of the gap between
// them, laid flat (gap_triangulation.h). What was measured stays bit for bit where it is. Memory: the mesh in
// `output`, the rest in scratch; CGAL's triangulation of the gap takes from the heap. Thread: any.
#pragma once

#include <optional>
#include <span>

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

// Closes every hole: one of three edges by a triangle, a larger one by a fan about a vertex in its middle.
void fan_holes(FaceMesh& mesh, Arena& scratch);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A head laid flat: radii about its upright axis, which stands kAxisBehind behind the tip of the nose, over
// arc and height. `own` holds what was measured, `added` what a completion proposes where nothing was.
// Millimetres, head frame. Memory: scratch. Thread: any.
#pragma once

#include <cmath>

#include "hal/base/arena.h"
#include "pipeline/mesh/landmarks/face_relief.h"
#include "pipeline/model/face_mesh.h"

namespace relievo::pipeline {

inline constexpr double kAxisBehind = 90;  // mm behind the tip: the head's upright axis
inline constexpr double kArcRadius = 80;   // mm: turns angles about it into lengths
inline constexpr double kHalfArc = 125;    // to the ears
inline constexpr double kBelow = 95, kAbove = 95;

// The surface with each vertex where `place` has it, without anything else. Memory: scratch.
template <typename Place>
FaceMesh laid_flat(const FaceMesh& mesh, Arena& scratch, Place&& place) {
  FaceMesh flat(&scratch);
  flat.vertices_mm.reserve(mesh.vertices_mm.size());
  for (const Vec3f& v : mesh.vertices_mm) flat.vertices_mm.push_back(place(v));
  flat.triangles = mesh.triangles;
  return flat;
}

// Arc, height and radius about the head's axis, and back.
Vec3f unrolled(const Vec3d& in_head);
Vec3d rolled(double arc, double y, double radius);

struct UnrolledHead {
  UnrolledHead(const FaceMesh& mesh, const RigidTransform& head_from_camera, double cell_mm, Arena& scratch);

  // Takes as added what the other side shows, wherever nothing was measured; moved by what the two differ
  // where both are known, relaxed into the new part (Laplace), so that no step is left at the seam.
  void add_other_side(double cell_mm, Arena& scratch);

  bool has_own(int c, int r) const { return own.inside(c, r) && !std::isnan(own.z(c, r)); }
  std::size_t index(int c, int r) const { return std::size_t(r * own.columns() + c); }
  std::size_t cells() const { return std::size_t(own.columns() * own.rows()); }

  FaceMesh flat;  // the surface, unrolled
  FaceRelief own, added;
  std::pmr::vector<float> distance_mm;  // of a cell from the measured ones, in city blocks
};

}  // namespace relievo::pipeline

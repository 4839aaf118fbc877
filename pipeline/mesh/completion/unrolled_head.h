// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A head laid flat: radii about its upright axis, which stands kAxisBehind behind the tip of the nose, over
// arc and height. `own` holds what was measured, `added` what a completion proposes where nothing was.
// Millimetres, head frame. Memory: scratch. Thread: any.
#pragma once

#include <algorithm>
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

class UnrolledHead {
 public:
  UnrolledHead(const FaceMesh& mesh, const RigidTransform& head_from_camera, double cell_mm, Arena& scratch);

  // Takes as added what `other`(column, row) says of every cell, NaN where it says nothing, wherever nothing
  // was measured; moved by what the two differ where both are known, relaxed into the new part (Laplace), so
  // that no step is left at the seam.
  template <typename Other>
  void add(Other&& other, double cell_mm, Arena& scratch) {
    std::pmr::vector<float> shift(cells(), 0.0F, &scratch);
    std::pmr::vector<std::uint8_t> fixed(cells(), 0, &scratch);
    for (int r = 0; r < own.rows(); ++r)
      for (int c = 0; c < own.columns(); ++c) {
        const float value = other(c, r);
        if (std::isnan(value)) continue;
        if (has_own(c, r))
          shift[index(c, r)] = std::clamp(own.z(c, r) - value, -4.0F, 4.0F), fixed[index(c, r)] = 1;
        else added.z(c, r) = value;
      }
    relax(shift, fixed);
    for (int r = 0; r < own.rows(); ++r)
      for (int c = 0; c < own.columns(); ++c) added.z(c, r) += shift[index(c, r)];
    measure_distance(float(cell_mm));
  }

  bool has_own(int c, int r) const { return own.inside(c, r) && !std::isnan(own.z(c, r)); }
  std::size_t index(int c, int r) const { return std::size_t(r * own.columns() + c); }
  std::size_t cells() const { return std::size_t(own.columns() * own.rows()); }

  FaceMesh flat;  // the surface, unrolled
  FaceRelief own, added;
  std::pmr::vector<float> distance_mm;  // of a cell from the measured ones, in city blocks

 private:
  void relax(std::pmr::vector<float>& shift, const std::pmr::vector<std::uint8_t>& fixed);
  void measure_distance(float cell_mm);
};

}  // namespace relievo::pipeline

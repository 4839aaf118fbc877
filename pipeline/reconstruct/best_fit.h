// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sphere and the plane through measured points, least squares of the distances along the normal
// (Gauss's fit, as coordinate metrology means it), and how far the points leave them. Millimetres.
// Errors: PoorGeometry (fewer than 20 points, or points that determine none). Thread: any.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline::best_fit {

struct Sphere {
  Vec3d centre_mm;
  double radius_mm = 0;
};

struct Plane {
  Vec3d point_mm;  // the middle of the points
  Vec3d normal;    // unit length, towards -z
};

Result<Sphere> fit_sphere(const std::vector<Vec3d>& points_mm);
Result<Plane> fit_plane(const std::vector<Vec3d>& points_mm);

// Signed: outside the sphere, on the normal's side of the plane.
inline double deviation(const Sphere& s, const Vec3d& p) { return distance(p, s.centre_mm) - s.radius_mm; }
inline double deviation(const Plane& s, const Vec3d& p) { return dot(minus(p, s.point_mm), s.normal); }

// A form that was fitted after at most `share` of the points, those furthest off, had been discarded.
template <typename Form>
struct FormReading {
  Form form;
  double range_mm = 0;  // largest minus smallest deviation of the points used
  double rms_mm = 0;
  std::size_t used = 0, discarded = 0;
};

Result<FormReading<Sphere>> read_sphere(const std::vector<Vec3d>& points_mm, double discard_share);
Result<FormReading<Plane>> read_plane(const std::vector<Vec3d>& points_mm, double discard_share);

// A point, and where it meets a surface.
struct Contact {
  Vec3d point_mm, surface_mm;
  Vec3d normal;  // of the surface, unit length
};
// The small motion about `pivot_mm` that lays the points on the surface: point to plane (Chen, Medioni 1992).
// None where they leave one open.
std::optional<RigidTransform> step_onto(const std::vector<Contact>& contacts, const Vec3d& pivot_mm);

}  // namespace relievo::pipeline::best_fit

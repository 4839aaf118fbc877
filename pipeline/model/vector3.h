// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The little arithmetic that directions and places need. Any unit, any frame, both operands in the same one.
#pragma once

#include <cmath>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

inline Vec3d minus(const Vec3d& a, const Vec3d& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3d scaled(const Vec3d& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
// From `place` by `s` along a direction.
inline Vec3d along(const Vec3d& place, double s, const Vec3d& direction) {
  return {place.x + s * direction.x, place.y + s * direction.y, place.z + s * direction.z};
}
inline double dot(const Vec3d& a, const Vec3d& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3d cross(const Vec3d& a, const Vec3d& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec3d& a) { return std::sqrt(dot(a, a)); }
// `a` must not be 0.
inline Vec3d unit(const Vec3d& a) { return scaled(a, 1 / length(a)); }

}  // namespace relievo::pipeline

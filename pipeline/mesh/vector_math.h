// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The few operations on Vec3f that meshing repeats everywhere.
#pragma once

#include <cmath>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline::mesh {

inline Vec3f plus(const Vec3f& a, const Vec3f& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3f minus(const Vec3f& a, const Vec3f& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3f times(const Vec3f& a, float s) { return {a.x * s, a.y * s, a.z * s}; }
inline float dot(const Vec3f& a, const Vec3f& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3f cross(const Vec3f& a, const Vec3f& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(const Vec3f& a) { return std::sqrt(dot(a, a)); }
inline float squared_distance(const Vec3f& a, const Vec3f& b) { return dot(minus(a, b), minus(a, b)); }
// The zero vector stays zero.
inline Vec3f unit(const Vec3f& a) {
  const float l = length(a);
  return l > 0 ? times(a, 1 / l) : a;
}

}  // namespace relievo::pipeline::mesh

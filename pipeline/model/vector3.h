// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The little arithmetic that directions and places need, of Vec3f and Vec3d. Any unit, any frame, both
// operands in the same one. Sums go from x to z: Eigen's may add in another order, and results would change
// in their last bit with its version. Systems of equations are Eigen's.
#pragma once

#include <cmath>
#include <concepts>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

template <typename V>
concept Vector3 = std::same_as<V, Vec3f> || std::same_as<V, Vec3d>;
template <Vector3 V>
using ScalarOf = decltype(V::x);

inline Vec3d wide(const Vec3f& a) { return {a.x, a.y, a.z}; }
inline Vec3f narrow(const Vec3d& a) { return {float(a.x), float(a.y), float(a.z)}; }
template <Vector3 V>
V plus(const V& a, const V& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <Vector3 V>
V minus(const V& a, const V& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <Vector3 V>
V times(const V& a, ScalarOf<V> s) {
  return {a.x * s, a.y * s, a.z * s};
}
// From `place` by `s` along a direction.
template <Vector3 V>
V along(const V& place, ScalarOf<V> s, const V& direction) {
  return plus(place, times(direction, s));
}
template <Vector3 V>
ScalarOf<V> dot(const V& a, const V& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <Vector3 V>
V cross(const V& a, const V& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <Vector3 V>
ScalarOf<V> length(const V& a) {
  return std::sqrt(dot(a, a));
}
template <Vector3 V>
ScalarOf<V> squared_distance(const V& a, const V& b) {
  return dot(minus(a, b), minus(a, b));
}
template <Vector3 V>
ScalarOf<V> distance(const V& a, const V& b) {
  return length(minus(a, b));
}
// The zero vector stays zero.
template <Vector3 V>
V unit(const V& a) {
  const ScalarOf<V> l = length(a);
  return l > 0 ? times(a, 1 / l) : a;
}

// What a step of a rigid registration does: turns about a pivot by a rotation vector (radians; Rodrigues),
// then moves. All in one frame, millimetres.
inline RigidTransform small_motion(const Vec3d& turn_rad, const Vec3d& shift_mm, const Vec3d& pivot_mm) {
  RigidTransform out;
  if (const double angle = length(turn_rad); angle > 1e-12) {
    const Vec3d a = times(turn_rad, 1 / angle), s = times(a, std::sin(angle));
    const double c = std::cos(angle);
    const Vec3d k = times(a, 1 - c);
    out.rotation = {{k.x * a.x + c, k.x * a.y - s.z, k.x * a.z + s.y, k.x * a.y + s.z, k.y * a.y + c,
                     k.y * a.z - s.x, k.x * a.z - s.y, k.y * a.z + s.x, k.z * a.z + c}};
  }
  out.translation_mm = plus(minus(pivot_mm, apply(out.rotation, pivot_mm)), shift_mm);
  return out;
}

}  // namespace relievo::pipeline

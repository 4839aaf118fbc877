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

}  // namespace relievo::pipeline

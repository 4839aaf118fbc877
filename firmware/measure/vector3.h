// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The little arithmetic that measuring needs. Any unit.
#pragma once

#include <cmath>

#include "pipeline/model/geometry.h"

namespace relievo::firmware::measure {

using pipeline::Vec3d;
using pipeline::Vec3f;

inline Vec3d wide(const Vec3f& a) { return {a.x, a.y, a.z}; }
inline Vec3d sum(const Vec3d& a, const Vec3d& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3d difference(const Vec3d& a, const Vec3d& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3d scaled(const Vec3d& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(const Vec3d& a, const Vec3d& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3d cross(const Vec3d& a, const Vec3d& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec3d& a) { return std::sqrt(dot(a, a)); }
inline double distance(const Vec3d& a, const Vec3d& b) { return length(difference(a, b)); }

}  // namespace relievo::firmware::measure

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The little arithmetic that measuring needs. Any unit.
#pragma once

#include "pipeline/model/vector3.h"

namespace relievo::firmware::measure {

using pipeline::cross;
using pipeline::dot;
using pipeline::length;
using pipeline::scaled;
using pipeline::Vec3d;
using pipeline::Vec3f;

inline Vec3d wide(const Vec3f& a) { return {a.x, a.y, a.z}; }
inline Vec3d sum(const Vec3d& a, const Vec3d& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3d difference(const Vec3d& a, const Vec3d& b) { return minus(a, b); }
inline double distance(const Vec3d& a, const Vec3d& b) { return length(difference(a, b)); }

}  // namespace relievo::firmware::measure

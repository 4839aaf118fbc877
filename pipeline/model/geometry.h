// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Plain numbers with names. Millimetres; x right, y down, z away from the rig (camera frames).
// Pixel (0, 0) is the centre of the top left pixel.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace relievo::pipeline {

struct Vec2f {
  float x = 0, y = 0;
};
struct Vec3f {
  float x = 0, y = 0, z = 0;
};
struct Vec2d {
  double x = 0, y = 0;
};
struct Vec3d {
  double x = 0, y = 0, z = 0;
};

// The pixels of a picture, row by row.
struct PixelGrid {
  int width_px = 0, height_px = 0;
  std::size_t pixels() const { return std::size_t(width_px) * std::size_t(height_px); }
  std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(width_px) + std::size_t(x); }
  bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < width_px && y < height_px; }
};

// Upright, in a picture.
struct Ellipse {
  double x, y, half_width, half_height;
  bool holds(double px, double py) const {
    const double u = (px - x) / half_width, v = (py - y) / half_height;
    return u * u + v * v < 1;
  }
};

// Row-major rotation. Variables are named target_from_source.
struct Rotation {
  double m[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
};

// Maps a point in the source frame to the target frame: p_target = R p + t (right_from_left).
struct RigidTransform {
  Rotation rotation;
  Vec3d translation_mm;
};

inline Vec3d apply(const Rotation& r, const Vec3d& p) {
  return {r.m[0] * p.x + r.m[1] * p.y + r.m[2] * p.z, r.m[3] * p.x + r.m[4] * p.y + r.m[5] * p.z,
          r.m[6] * p.x + r.m[7] * p.y + r.m[8] * p.z};
}
// First b, then a.
inline Rotation product(const Rotation& a, const Rotation& b) {
  Rotation c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      c.m[3 * i + j] = a.m[3 * i] * b.m[j] + a.m[3 * i + 1] * b.m[3 + j] + a.m[3 * i + 2] * b.m[6 + j];
  return c;
}
// By how much it turns, 0 to 180.
inline double turned_deg(const Rotation& r) {
  return std::acos(std::clamp((r.m[0] + r.m[4] + r.m[8] - 1) / 2, -1.0, 1.0)) * 180 / std::numbers::pi;
}

inline Rotation transposed(const Rotation& r) {
  return {{r.m[0], r.m[3], r.m[6], r.m[1], r.m[4], r.m[7], r.m[2], r.m[5], r.m[8]}};
}
inline Vec3d apply(const RigidTransform& t, const Vec3d& p) {
  const Vec3d q = apply(t.rotation, p);
  return {q.x + t.translation_mm.x, q.y + t.translation_mm.y, q.z + t.translation_mm.z};
}
// First b, then a.
inline RigidTransform product(const RigidTransform& a, const RigidTransform& b) {
  return {product(a.rotation, b.rotation), apply(a, b.translation_mm)};
}
inline RigidTransform inverse(const RigidTransform& t) {
  const Rotation back = transposed(t.rotation);
  const Vec3d q = apply(back, t.translation_mm);
  return {back, {-q.x, -q.y, -q.z}};
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Three numbers and a 3 x 3 matrix: all the algebra the simulated world needs. It has its own on
// purpose: what judges the reconstruction may share nothing with it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace relievo::hal::sim {

struct Vec3 {
  double x = 0, y = 0, z = 0;
  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator*(Vec3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  constexpr Vec3& operator+=(Vec3 b) { return *this = *this + b; }
};

constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline Vec3 normalised(Vec3 a) {
  const double l = length(a);
  return l > 0 ? a * (1 / l) : Vec3{0, 0, 1};
}
constexpr double mix(double a, double b, double t) { return a + (b - a) * t; }
constexpr Vec3 mix(Vec3 a, Vec3 b, double t) { return a + (b - a) * t; }
constexpr double clamp01(double t) { return std::clamp(t, 0.0, 1.0); }
constexpr double smoothstep(double from, double to, double t) {
  const double s = clamp01((t - from) / (to - from));
  return s * s * (3 - 2 * s);
}
inline double gauss(double t) { return std::exp(-t * t); }

struct Mat3 {
  std::array<Vec3, 3> row{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  friend constexpr Vec3 operator*(const Mat3& m, Vec3 v) {
    return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
  }
  constexpr Mat3 transposed() const {
    return {{Vec3{row[0].x, row[1].x, row[2].x}, Vec3{row[0].y, row[1].y, row[2].y},
             Vec3{row[0].z, row[1].z, row[2].z}}};
  }
  friend constexpr Mat3 operator*(const Mat3& a, const Mat3& b) {
    const Mat3 t = b.transposed();
    return {{t * a.row[0], t * a.row[1], t * a.row[2]}};
  }
};

// Turns about x, then y, then z (radians), right-handed.
inline Mat3 rotation(double about_x, double about_y, double about_z) {
  const double a = std::cos(about_x), b = std::sin(about_x), c = std::cos(about_y), d = std::sin(about_y);
  const double e = std::cos(about_z), f = std::sin(about_z);
  const Mat3 x{{Vec3{1, 0, 0}, Vec3{0, a, -b}, Vec3{0, b, a}}};
  const Mat3 y{{Vec3{c, 0, d}, Vec3{0, 1, 0}, Vec3{-d, 0, c}}};
  const Mat3 z{{Vec3{e, -f, 0}, Vec3{f, e, 0}, Vec3{0, 0, 1}}};
  return z * (y * x);
}

// Where a board or an artefact is.
struct BodyPose {
  Mat3 world_from_body;
  Vec3 origin_mm;  // of the body, in world
  Vec3 to_world(Vec3 p) const { return world_from_body * p + origin_mm; }
  Vec3 to_body(Vec3 p) const { return world_from_body.transposed() * (p - origin_mm); }
  Vec3 normal() const { return world_from_body * Vec3{0, 0, 1}; }
};

constexpr double radians(double degrees) { return degrees * 0.017453292519943295; }

}  // namespace relievo::hal::sim

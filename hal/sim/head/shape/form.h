// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sculptor's tools: distances to simple bodies and ways to blend them. A field is negative
// inside; values near the surface are distances in mm, further off only their sign can be trusted.
#pragma once

#include <initializer_list>
#include <vector>

#include "hal/sim/base/vec3.h"

namespace relievo::hal::sim {

// Unions and cuts that round the seam over a width of about k (cubic blend, I. Quilez).
inline double join(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * h * k / 6;
}
inline double cut(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::max(a, b) + h * h * h * k / 6;
}

inline double ellipsoid(Vec3 p, Vec3 radii) {
  const Vec3 a{p.x / radii.x, p.y / radii.y, p.z / radii.z};
  const Vec3 b{a.x / radii.x, a.y / radii.y, a.z / radii.z};
  const double k0 = length(a), k1 = length(b);
  return k1 > 0 ? k0 * (k0 - 1) / k1 : -std::min({radii.x, radii.y, radii.z});
}

struct Bead {
  Vec3 at;
  double radius = 0;
};
// A capsule whose radius changes linearly.
inline double tapered(Vec3 p, const Bead& a, const Bead& b) {
  const Vec3 along = b.at - a.at, from = p - a.at;
  const double t = clamp01(dot(from, along) / dot(along, along));
  return length(from - along * t) - mix(a.radius, b.radius, t);
}

// Bell of height 1: exp(-(d/width)^2) in each direction.
inline double bell(double dx, double wx, double dy, double wy) {
  const double q = (dx / wx) * (dx / wx) + (dy / wy) * (dy / wy);
  return q > 9 ? 0 : std::exp(-q);
}
inline double bell(Vec3 d, Vec3 w) {
  const double q = (d.x / w.x) * (d.x / w.x) + (d.y / w.y) * (d.y / w.y) + (d.z / w.z) * (d.z / w.z);
  return q > 9 ? 0 : std::exp(-q);
}

// A smooth curve through points with rising x; constant slope outside.
class Curve {
 public:
  struct Knot {
    double x, y;
  };
  Curve() = default;
  Curve(std::initializer_list<Knot> knots);
  double operator()(double x) const;

 private:
  std::vector<Knot> knots_;
  std::vector<double> slopes_;
};

// A string of beads, smoothly threaded: the distance to the thickest neighbourhood of it.
class BeadString {
 public:
  BeadString() = default;
  BeadString(std::initializer_list<Bead> beads, int pieces_between);
  double distance(Vec3 p) const;

 private:
  std::vector<Bead> beads_;
};

}  // namespace relievo::hal::sim

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/measure/rigid_fit.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace relievo::firmware::measure {
namespace {

using Row6 = std::array<double, 6>;
struct Normal6 {
  std::array<Row6, 6> a{};
  Row6 b{};
};

// Cholesky; the matrix is positive definite where the points do not all lie on one plane.
bool solve(Normal6 system, Row6& x) {
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double s = system.a[i][j];
      for (std::size_t k = 0; k < j; ++k) s -= system.a[i][k] * system.a[j][k];
      if (i == j && s <= 0) return false;
      system.a[i][j] = i == j ? std::sqrt(s) : s / system.a[j][j];
    }
  }
  for (std::size_t i = 0; i < 6; ++i) {
    x[i] = system.b[i];
    for (std::size_t k = 0; k < i; ++k) x[i] -= system.a[i][k] * x[k];
    x[i] /= system.a[i][i];
  }
  for (std::size_t i = 6; i-- > 0;) {
    for (std::size_t k = i + 1; k < 6; ++k) x[i] -= system.a[k][i] * x[k];
    x[i] /= system.a[i][i];
  }
  return true;
}

pipeline::Rotation rotation_of(const Vec3d& w) {  // Rodrigues
  const double angle = length(w);
  if (angle < 1e-15) return {};
  const Vec3d u = times(w, 1 / angle);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double v = 1 - c;
  return {{c + u.x * u.x * v, u.x * u.y * v - u.z * s, u.x * u.z * v + u.y * s, u.y * u.x * v + u.z * s,
           c + u.y * u.y * v, u.y * u.z * v - u.x * s, u.z * u.x * v - u.y * s, u.z * u.y * v + u.x * s,
           c + u.z * u.z * v}};
}

}  // namespace

RigidFit fit_rigidly(const std::vector<Vec3d>& points, const TriangleGrid& surface) {
  RigidFit fit;
  if (points.empty()) return fit;
  pipeline::RigidTransform& t = fit.surface_from_points;
  // About the middle of the points: turning and moving are then nearly independent.
  const Vec3d middle = points[points.size() / 2];
  for (int round = 0; round < 25; ++round) {
    const double reach_mm = round < 6 ? 12 : round < 12 ? 4 : 1.5;
    Normal6 system;
    int used = 0;
    for (const Vec3d& point : points) {
      const Vec3d p = apply(t, point);
      const auto near = surface.nearest(p, reach_mm);
      if (!near) continue;
      const Vec3d lever = cross(minus(p, middle), near->normal);
      const Row6 j{lever.x, lever.y, lever.z, near->normal.x, near->normal.y, near->normal.z};
      const double error = dot(minus(near->at_mm, p), near->normal);
      for (std::size_t r = 0; r < 6; ++r) {
        for (std::size_t c = 0; c < 6; ++c) system.a[r][c] += j[r] * j[c];
        system.b[r] += j[r] * error;
      }
      ++used;
    }
    Row6 x{};
    if (used < 100 || !solve(system, x)) break;
    const pipeline::Rotation turn = rotation_of({x[0], x[1], x[2]});
    const Vec3d moved = plus(apply(turn, minus(t.translation_mm, middle)), plus(middle, {x[3], x[4], x[5]}));
    t = {product(turn, t.rotation), moved};
    if (length(Vec3d{x[0], x[1], x[2]}) + length(Vec3d{x[3], x[4], x[5]}) < 1e-7) break;
  }
  fit.moved_mm = distance(apply(t, middle), middle);
  const double trace = t.rotation.m[0] + t.rotation.m[4] + t.rotation.m[8];
  fit.turned_deg = std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0)) * 180 / std::numbers::pi;
  return fit;
}

}  // namespace relievo::firmware::measure

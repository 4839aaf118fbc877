// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/head/mirror_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace relievo::pipeline {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Vec3d sum(const Vec3d& a, double s, const Vec3d& b) { return {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z}; }
double dot(const Vec3d& a, const Vec3d& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3d unit(const Vec3d& a) { return sum({}, 1 / std::sqrt(dot(a, a)), a); }
Vec3d cross(const Vec3d& a, const Vec3d& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

struct Search {
  const Relief& relief;
  std::span<const Vec3d> points;
  const Vec3d& tip;
  const HeadAxes& axes;
  double limit_mm;

  // Mean squared distance, in depth, between the points' mirror images and the relief behind them. An image that falls where
  // nothing is known costs a third of the limit: else planes that send the face away would look good.
  double cost(const MirrorPlane& plane, std::size_t every) const {
    const Vec3d n = normal_of(plane, axes);
    double total = 0;
    int count = 0;
    for (std::size_t i = 0; i < points.size(); i += every, ++count) {
      const Vec3d& p = points[i];
      const double away = (p.x - tip.x) * n.x + (p.y - tip.y) * n.y + (p.z - tip.z) * n.z - plane.offset_mm;
      const Vec3d image = sum(p, -2 * away, n);
      const Vec2d at = relief.pixel(image);
      const int x = static_cast<int>(std::lround(at.x)), y = static_cast<int>(std::lround(at.y));
      double off = limit_mm / 3;
      if (relief.inside(x, y) && relief.known(x, y)) off = std::min(limit_mm, std::abs(image.z - static_cast<double>(relief.depth_mm[relief.index(x, y)])));
      total += off * off;
    }
    return total / std::max(1, count);
  }
};

// Steps along each of the three, halved when none helps.
MirrorPlane refine(const Search& search, MirrorPlane best) {
  double least = search.cost(best, 1);
  std::array<double, 3> step{4, 5, 3};
  for (int round = 0; round < 24 && step[0] > 0.2; ++round) {
    bool better = false;
    for (int k = 0; k < 6; ++k) {
      MirrorPlane tried = best;
      const double by = (k % 2 == 0 ? 1 : -1) * step[static_cast<std::size_t>(k / 2)];
      (k / 2 == 0 ? tried.yaw_deg : k / 2 == 1 ? tried.roll_deg : tried.offset_mm) += by;
      const double cost = search.cost(tried, 1);
      if (cost >= least) continue;
      least = cost;
      best = tried;
      better = true;
    }
    if (!better)
      for (double& s : step) s /= 2;
  }
  best.rms_mm = std::sqrt(least);
  return best;
}

}  // namespace

HeadAxes axes_facing_the_rig(const Vec3d& at, double baseline_mm) {
  HeadAxes axes;
  axes.away = unit({at.x - baseline_mm / 2, at.y, at.z});
  axes.right = unit(sum({1, 0, 0}, -axes.away.x, axes.away));
  axes.down = cross(axes.away, axes.right);
  return axes;
}

Vec3d normal_of(const MirrorPlane& plane, const HeadAxes& axes) {
  const double yaw = plane.yaw_deg * kDegree, roll = plane.roll_deg * kDegree;
  const Vec3d turned = sum(sum({}, std::cos(yaw), axes.right), std::sin(yaw), axes.away);
  return sum(sum({}, std::cos(roll), turned), -std::sin(roll), axes.down);
}

std::array<MirrorPlane, 3> find_mirror_planes(const Relief& relief, std::span<const Vec3d> points, const Vec3d& tip, const HeadAxes& axes, double limit_mm) {
  const Search search{relief, points, tip, axes, limit_mm};
  const std::size_t every = std::max<std::size_t>(1, points.size() / 150);
  std::array<MirrorPlane, 3> best;
  std::array<double, 3> least{1e300, 1e300, 1e300};
  for (double yaw = -45; yaw <= 45; yaw += 9) {
    const std::size_t range = yaw < -13 ? 0 : yaw > 13 ? 2 : 1;
    for (double roll = -36; roll <= 36; roll += 9)
      for (double offset = -12; offset <= 12; offset += 6) {
        const MirrorPlane tried{yaw, roll, offset, 0};
        const double cost = search.cost(tried, every);
        if (cost >= least[range]) continue;
        least[range] = cost;
        best[range] = tried;
      }
  }
  for (MirrorPlane& plane : best) plane = refine(search, plane);
  return best;
}

}  // namespace relievo::pipeline

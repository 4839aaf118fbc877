// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/head/mirror_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kUprightDeg =
    7;  // heads are mostly upright: one leaning by so much must mirror itself better by a square millimetre
// Of a turned head's own plane a fifth of the images falls where nothing is known, of one that sends the face
// away most.
constexpr double kMostUnknown = 0.35, kPriceOfUnknown = 100;
constexpr double kMostOffsetMm = 15;  // of a head's mirror plane from the tip of its nose

struct Search {
  const Relief& relief;
  std::span<const Vec3d> points;
  const Vec3d& tip;
  const HeadAxes& axes;
  double limit_mm;
  bool upright = true;  // whether leaning has a price

  // Mean squared distance, in depth, between the points' mirror images and the relief behind them. An image
  // that falls where nothing is known costs a third of the limit, and more where many do: else planes that
  // send the face away would look good. Given up, and `least` returned, as soon as it cannot be less than
  // that any more.
  double cost(const MirrorPlane& plane, std::size_t every, double least = 1e300) const {
    const Vec3d n = normal_of(plane, axes);
    const double lean = upright ? plane.roll_deg / kUprightDeg : 0;
    const double most = (least - lean * lean) * static_cast<double>((points.size() + every - 1) / every);
    double total = 0;
    int count = 0, unknown = 0;
    for (std::size_t i = 0; i < points.size(); i += every, ++count) {
      const Vec3d& p = points[i];
      const Vec3d image = along(p, -2 * (dot(minus(p, tip), n) - plane.offset_mm), n);
      const Vec2d at = relief.pixel(image);
      const int x = Relief::nearest(at.x), y = Relief::nearest(at.y);
      double off = limit_mm / 3;
      if (!relief.inside(x, y) || !relief.known(x, y)) ++unknown;
      else
        off =
            std::min(limit_mm, std::abs(image.z - static_cast<double>(relief.depth_mm[relief.index(x, y)])));
      total += off * off;
      if (total > most) return least;
    }
    const double away = std::max(0.0, static_cast<double>(unknown) / std::max(1, count) - kMostUnknown);
    return total / std::max(1, count) + lean * lean + kPriceOfUnknown * away;
  }
};

// Steps along each of the three, halved when none helps.
MirrorPlane refine(const Search& search, MirrorPlane best, std::array<double, 3> step) {
  double least = search.cost(best, 1);
  for (int round = 0; round < 24 && step[0] > 0.2; ++round) {
    bool better = false;
    for (int k = 0; k < 6; ++k) {
      MirrorPlane tried = best;
      const double by = (k % 2 == 0 ? 1 : -1) * step[static_cast<std::size_t>(k / 2)];
      (k / 2 == 0 ? tried.yaw_deg : k / 2 == 1 ? tried.roll_deg : tried.offset_mm) += by;
      if (std::abs(tried.offset_mm) > kMostOffsetMm) continue;
      const double cost = search.cost(tried, 1, least);
      if (cost >= least) continue;
      least = cost;
      best = tried;
      better = true;
    }
    if (!better)
      for (double& s : step) s /= 2;
  }
  return best;
}

}  // namespace

HeadAxes axes_facing_the_rig(const Vec3d& at, double baseline_mm) {
  HeadAxes axes;
  axes.away = unit(Vec3d{at.x - baseline_mm / 2, at.y, at.z});
  axes.right = unit(along({1, 0, 0}, -axes.away.x, axes.away));
  axes.down = cross(axes.away, axes.right);
  return axes;
}

Vec3d normal_of(const MirrorPlane& plane, const HeadAxes& axes) {
  const double yaw = plane.yaw_deg * kDegree, roll = plane.roll_deg * kDegree;
  const Vec3d turned = along(times(axes.right, std::cos(yaw)), std::sin(yaw), axes.away);
  return along(times(turned, std::cos(roll)), -std::sin(roll), axes.down);
}

std::array<MirrorPlane, 3> find_mirror_planes(const Relief& relief, std::span<const Vec3d> points,
                                              const Vec3d& tip, const HeadAxes& axes, double limit_mm) {
  const Search search{relief, points, tip, axes, limit_mm};
  const std::size_t every = std::max<std::size_t>(1, points.size() / 150);
  std::array<MirrorPlane, 3> best;
  std::array<double, 3> least{1e300, 1e300, 1e300};
  for (double yaw = -45; yaw <= 45; yaw += 9) {
    const std::size_t range = yaw < -13 ? 0 : yaw > 13 ? 2 : 1;
    for (double roll = -36; roll <= 36; roll += 9)
      for (double offset = -12; offset <= 12; offset += 6) {
        const MirrorPlane tried{yaw, roll, offset, 0};
        const double cost = search.cost(tried, every, least[range]);
        if (cost >= least[range]) continue;
        least[range] = cost;
        best[range] = tried;
      }
  }
  const Search unbiased{relief, points, tip, axes, limit_mm, false};
  for (MirrorPlane& plane : best) {
    plane = refine(search, plane, {4, 5, 3});
    plane = refine(unbiased, plane, {1, 1.5, 0.75});
    plane.rms_mm = std::sqrt(unbiased.cost(plane, 1));
    plane.price = std::sqrt(search.cost(plane, 1));
  }
  return best;
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/quality/held_out_shift.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "pipeline/base/solving.h"
#include "pipeline/calibrate/quality/rig_geometry.h"

namespace relievo::pipeline {
namespace {

struct Missed {
  Vec2d at;
  double distance_px = 0;  // signed, below the line
};

std::vector<Missed> missed_lines(const bundle::Problem& rig, const BoardView& view) {
  const double focal = 0.5 * (rig.camera[1].focal_px.x + rig.camera[1].focal_px.y);
  std::vector<Missed> all;
  for (std::size_t i = 0; i < view.left.size(); ++i) {
    if (!seen(view.left[i]) || !seen(view.right[i])) continue;
    const Eigen::Vector3d turned = rig.right_from_left.rotation * ray_of(rig.camera[0], view.left[i]);
    const Eigen::Vector3d line = rig.right_from_left.translation_mm.cross(turned);
    const double distance = focal * line.dot(ray_of(rig.camera[1], view.right[i])) / line.head<2>().norm();
    all.push_back({view.right[i], std::copysign(distance, line.y() * distance)});
  }
  return all;
}

// Sum over the corners of the squared linear field that fits their misses best.
double field_squared(const std::vector<Missed>& missed) {
  Vec2d middle;
  for (const Missed& m : missed) middle = {middle.x + m.at.x, middle.y + m.at.y};
  const auto count = static_cast<double>(missed.size());
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const Missed& m : missed) {
    const Eigen::Vector3d basis(1, (m.at.x - middle.x / count) / 100, (m.at.y - middle.y / count) / 100);
    a += basis * basis.transpose();
    b += m.distance_px * basis;
  }
  return b.dot(solved<3>(a, b));
}

}  // namespace

double held_out_shift(const Fitted& f, const RigSpread& spread) {
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < f.selection.used.size(); ++i) {
    const auto missed =
        missed_lines(spread.without()[i], f.input.views[static_cast<std::size_t>(f.selection.used[i])]);
    if (missed.size() < 4) continue;
    sum += field_squared(missed);
    count += static_cast<double>(missed.size());
  }
  return std::sqrt(sum / std::max(count, 1.0));
}

}  // namespace relievo::pipeline

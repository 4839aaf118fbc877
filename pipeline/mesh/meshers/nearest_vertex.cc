// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/meshers/nearest_vertex.h"

#include <algorithm>
#include <cmath>

#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr float kPointsPerCell = 2;
constexpr float kObliquity =
    0.5F;  // a step in x/z is at least so much of an angle within 60 degrees of the axis

}  // namespace

NearestVertex::NearestVertex(std::span<const Vec3f> points, std::pmr::memory_resource* memory)
    : points_(points), cells_(memory) {
  if (points.empty()) return;
  left_ = top_ = 1e9F;
  float right = -1e9F, bottom = -1e9F;
  for (const Vec3f& p : points) {
    left_ = std::min(left_, p.x / p.z);
    right = std::max(right, p.x / p.z);
    top_ = std::min(top_, p.y / p.z);
    bottom = std::max(bottom, p.y / p.z);
  }
  side_ =
      std::sqrt(std::max((right - left_) * (bottom - top_), 1e-9F) * kPointsPerCell / float(points.size()));
  const int columns = int((right - left_) / side_) + 1;
  const int rows = int((bottom - top_) / side_) + 1;
  cells_.fill(columns, rows, [&](auto&& add) {
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const Vec3f& p = points[i];
      add(std::clamp(int((p.x / p.z - left_) / side_), 0, columns - 1),
          std::clamp(int((p.y / p.z - top_) / side_), 0, rows - 1), i);
    }
  });
}

NearestVertex::Hit NearestVertex::find(const Vec3f& at, float within_mm) const {
  Hit best{kNone, within_mm * within_mm};
  if (points_.empty()) return best;
  const int c = int(std::floor((at.x / at.z - left_) / side_));
  const int r = int(std::floor((at.y / at.z - top_) / side_));
  const auto done = [&](int ring) {
    // What lies beyond the rings seen so far is further away across the line of sight alone.
    const float beyond = float(ring - 1) * side_ * kObliquity * at.z;
    return ring > 0 && beyond > 0 && beyond * beyond >= best.squared_mm;
  };
  cells_.by_rings(c, r, done, [&](std::uint32_t i) {
    const float square = squared_distance(points_[i], at);
    if (square < best.squared_mm) best = {i, square};
  });
  return best;
}

}  // namespace relievo::pipeline

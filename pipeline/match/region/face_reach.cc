// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/region/face_reach.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace relievo::pipeline {
namespace {

constexpr double kNearest = 0.01;
constexpr std::size_t kLeast = 50;    // nodes in the middle; of fewer nothing can be said

}  // namespace

Vec3d nearest_tip(std::span<Vec3d> middle) {
  const auto count = std::max<std::size_t>(10, static_cast<std::size_t>(kNearest * static_cast<double>(middle.size())));
  const std::span<Vec3d> nearest = middle.first(std::min(count, middle.size()));
  std::nth_element(middle.begin(), middle.begin() + static_cast<std::ptrdiff_t>(nearest.size() - 1), middle.end(),
                   [](const Vec3d& a, const Vec3d& b) { return a.z < b.z; });
  Vec3d tip;
  for (const Vec3d& p : nearest) {
    tip.x += p.x / static_cast<double>(nearest.size());
    tip.y += p.y / static_cast<double>(nearest.size());
    tip.z += p.z / static_cast<double>(nearest.size());
  }
  return tip;
}

void keep_within_reach(const RectifiedPair& pair, StageContext& context, SurfaceField& field) {
  if (!(pair.face_reach_mm > 0 && pair.face_width_px > 0)) return;
  Arena::Mark mark(context.scratch);
  const auto point = [&](int i, int j) {
    const double z = pair.depth_mm(static_cast<double>(field.disparity_px.row(j)[i]));
    return Vec3d{(i * field.step_px - pair.left_centre_px.x) * z / pair.focal_px,
                 (j * field.step_px - pair.left_centre_px.y) * z / pair.focal_px, z};
  };
  std::pmr::vector<Vec3d> middle(&context.scratch);
  middle.reserve(field.domain.values.size());
  for (int j = 0; j < field.domain.height; ++j)
    for (int i = 0; i < field.domain.width; ++i)
      if (field.domain.row(j)[i] != 0 && std::hypot(i * field.step_px - pair.face_centre_px.x, j * field.step_px - pair.face_centre_px.y) < kNoseReach * pair.face_width_px)
        middle.push_back(point(i, j));
  if (middle.size() < kLeast) return;
  const Vec3d tip = nearest_tip(middle);
  const double reach2 = pair.face_reach_mm * pair.face_reach_mm;
  for (int j = 0; j < field.domain.height; ++j)
    for (int i = 0; i < field.domain.width; ++i) {
      if (field.domain.row(j)[i] == 0) continue;
      const Vec3d at = point(i, j);
      const double dx = at.x - tip.x, dy = at.y - tip.y, dz = at.z - tip.z;
      if (!(dx * dx + dy * dy + dz * dz <= reach2)) field.domain.row(j)[i] = 0;
    }
}

}  // namespace relievo::pipeline

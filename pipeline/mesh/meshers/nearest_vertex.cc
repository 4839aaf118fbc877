// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/meshers/nearest_vertex.h"

#include <algorithm>
#include <cmath>

#include "pipeline/mesh/vector_math.h"

namespace relievo::pipeline {
namespace {

constexpr float kPointsPerCell = 2;
constexpr float kObliquity =
    0.5F;  // a step in x/z is at least so much of an angle within 60 degrees of the axis

}  // namespace

NearestVertex::NearestVertex(std::span<const Vec3f> points, std::pmr::memory_resource* memory)
    : points_(points), first_(memory), members_(memory) {
  if (points.empty()) return;
  left_ = top_ = 1e9F;
  float right = -1e9F, bottom = -1e9F;
  for (const Vec3f& p : points) {
    left_ = std::min(left_, p.x / p.z);
    right = std::max(right, p.x / p.z);
    top_ = std::min(top_, p.y / p.z);
    bottom = std::max(bottom, p.y / p.z);
  }
  side_ = std::sqrt(std::max((right - left_) * (bottom - top_), 1e-9F) * kPointsPerCell /
                    static_cast<float>(points.size()));
  columns_ = static_cast<int>((right - left_) / side_) + 1;
  rows_ = static_cast<int>((bottom - top_) / side_) + 1;
  const auto cell_of = [this](const Vec3f& p) {
    const int c = std::clamp(static_cast<int>((p.x / p.z - left_) / side_), 0, columns_ - 1);
    const int r = std::clamp(static_cast<int>((p.y / p.z - top_) / side_), 0, rows_ - 1);
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c);
  };
  first_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0U);
  members_.assign(points.size(), 0U);
  for (const Vec3f& p : points) ++first_[cell_of(p) + 1];
  for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
  for (std::uint32_t i = 0; i < points.size(); ++i) members_[first_[cell_of(points[i])]++] = i;
  std::copy_backward(first_.begin(), first_.end() - 1, first_.end());
  first_[0] = 0;
}

NearestVertex::Hit NearestVertex::find(const Vec3f& at, float within_mm) const {
  Hit best{kNone, within_mm * within_mm};
  if (points_.empty()) return best;
  const int c = static_cast<int>(std::floor((at.x / at.z - left_) / side_));
  const int r = static_cast<int>(std::floor((at.y / at.z - top_) / side_));
  for (int ring = 0;; ++ring) {
    // What lies beyond the rings seen so far is further away across the line of sight alone.
    const float beyond = static_cast<float>(ring - 1) * side_ * kObliquity * at.z;
    if (ring > 0 && beyond > 0 && beyond * beyond >= best.squared_mm) return best;
    for (int y = std::max(r - ring, 0); y <= std::min(r + ring, rows_ - 1); ++y) {
      const int stride = y == r - ring || y == r + ring || ring == 0 ? 1 : 2 * ring;
      for (int x = c - ring; x <= c + ring; x += stride) {
        if (x < 0 || x >= columns_) continue;
        const std::size_t k =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
        for (std::uint32_t i = first_[k]; i < first_[k + 1]; ++i) {
          const float square = mesh::squared_distance(points_[members_[i]], at);
          if (square < best.squared_mm) best = {members_[i], square};
        }
      }
    }
  }
}

}  // namespace relievo::pipeline

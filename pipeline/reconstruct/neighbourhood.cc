// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/reconstruct/neighbourhood.h"

#include <algorithm>
#include <cmath>

namespace relievo::pipeline {
namespace {

constexpr float kLargestPixel = 100'000;
constexpr double kPointsPerBucket =
    3;  // nine buckets then hold about as many points as a lattice's neighbourhood

bool usable(const CloudPoint& p) {
  return std::isfinite(p.at_mm.x) && std::isfinite(p.at_mm.y) && std::isfinite(p.at_mm.z) && p.at_mm.z > 0 &&
         std::abs(p.left_px.x) < kLargestPixel && std::abs(p.left_px.y) < kLargestPixel;
}

}  // namespace

Neighbourhood::Neighbourhood(const PointCloud& cloud, std::pmr::memory_resource* memory)
    : on_lattice_(cloud.lattice_step_px > 0), first_(memory), members_(memory) {
  float left = kLargestPixel;
  float top = kLargestPixel;
  float right = -kLargestPixel;
  float bottom = -kLargestPixel;
  std::size_t count = 0;
  for (const CloudPoint& p : cloud.points) {
    if (!usable(p)) continue;
    ++count;
    left = std::min(left, p.left_px.x);
    right = std::max(right, p.left_px.x);
    top = std::min(top, p.left_px.y);
    bottom = std::max(bottom, p.left_px.y);
  }
  if (count == 0) return;
  const double area = static_cast<double>(right - left + 1) * static_cast<double>(bottom - top + 1);
  const double step = on_lattice_
                          ? cloud.lattice_step_px
                          : std::max(1e-3, std::sqrt(area * kPointsPerBucket / static_cast<double>(count)));
  const auto cell_of = [step](float from, float at) {
    return static_cast<int>(std::lround(static_cast<double>(at - from) / step));
  };
  columns_ = cell_of(left, right) + 1;
  rows_ = cell_of(top, bottom) + 1;
  const auto place = [&](const CloudPoint& p) {
    return static_cast<std::size_t>(cell_of(top, p.left_px.y)) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(cell_of(left, p.left_px.x));
  };
  first_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 2, 0U);
  members_.assign(count, 0U);
  // Counting sort; shifted by two so that filling leaves each start in place.
  for (const CloudPoint& p : cloud.points)
    if (usable(p)) ++first_[place(p) + 2];
  for (std::size_t k = 2; k < first_.size(); ++k) first_[k] += first_[k - 1];
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    if (usable(cloud.points[i]))
      members_[first_[place(cloud.points[i]) + 1]++] = static_cast<std::uint32_t>(i);
}

}  // namespace relievo::pipeline

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
    : on_lattice_(cloud.lattice_step_px > 0), cells_(memory) {
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
  const double area = double(right - left + 1) * double(bottom - top + 1);
  const double step = on_lattice_ ? cloud.lattice_step_px
                                  : std::max(1e-3, std::sqrt(area * kPointsPerBucket / double(count)));
  const auto cell_of = [step](float from, float at) { return int(std::lround(double(at - from) / step)); };
  cells_.fill(cell_of(left, right) + 1, cell_of(top, bottom) + 1, [&](auto&& add) {
    for (std::uint32_t i = 0; i < cloud.points.size(); ++i)
      if (const CloudPoint& p = cloud.points[i]; usable(p))
        add(cell_of(left, p.left_px.x), cell_of(top, p.left_px.y), i);
  });
}

}  // namespace relievo::pipeline

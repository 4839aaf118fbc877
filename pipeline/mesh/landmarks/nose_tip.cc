// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/landmarks/nose_tip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace relievo::pipeline {
namespace {

using Eigen::Vector3d;

constexpr double kRingFrom = 18, kRingTo = 28;  // mm; beyond the wings of a nose, within its cheeks
constexpr int kSectors = 8;
constexpr int kSectorsNeeded = 5;  // one flank of the nose may hide its cheek

// Negative where the surroundings cannot be judged.
double protrusion(std::span<const SurfacePoint> points, const Vector3d& at) {
  Vector3d out = Vector3d::Zero();
  for (const SurfacePoint& q : points)
    if ((q.at_mm - at).squaredNorm() < 12.0 * 12.0) out += q.normal;
  if (!(out.norm() > 0)) return -1;
  out.normalize();
  const Vector3d across =
      (std::abs(out.x()) < 0.8 ? Vector3d::UnitX() : Vector3d::UnitY()).cross(out).normalized();
  const Vector3d along = out.cross(across);
  std::array<double, kSectors> sum{};
  std::array<int, kSectors> count{};
  for (const SurfacePoint& q : points) {
    const Vector3d d = q.at_mm - at;
    const double u = d.dot(across);
    const double v = d.dot(along);
    const double ring = u * u + v * v;
    const double behind = -d.dot(out);
    if (ring < kRingFrom * kRingFrom || ring > kRingTo * kRingTo || std::abs(behind) > 50) continue;
    const double turn = (std::atan2(v, u) / std::numbers::pi + 1) / 2;
    const auto k = static_cast<std::size_t>(std::clamp(static_cast<int>(turn * kSectors), 0, kSectors - 1));
    sum[k] += behind;
    ++count[k];
  }
  double mean = 0;
  int sectors = 0;
  for (std::size_t k = 0; k < kSectors; ++k) {
    if (count[k] < 3) continue;
    mean += sum[k] / count[k];
    ++sectors;
  }
  return sectors < kSectorsNeeded ? -1 : mean / sectors;
}

void keep(NoseCandidates& found, const NoseCandidate& candidate) {
  for (std::size_t i = 0; i < found.count; ++i) {
    if ((found.best[i].at_mm - candidate.at_mm).norm() > 25) continue;
    if (found.best[i].protrusion_mm >= candidate.protrusion_mm) return;
    std::copy(found.best.begin() + static_cast<std::ptrdiff_t>(i) + 1,
              found.best.begin() + static_cast<std::ptrdiff_t>(found.count),
              found.best.begin() + static_cast<std::ptrdiff_t>(i));
    --found.count;
    --i;
  }
  if (found.count == found.best.size()) {
    if (found.best.back().protrusion_mm >= candidate.protrusion_mm) return;
    --found.count;
  }
  std::size_t place = found.count++;
  for (; place > 0 && found.best[place - 1].protrusion_mm < candidate.protrusion_mm; --place)
    found.best[place] = found.best[place - 1];
  found.best[place] = candidate;
}

}  // namespace

NoseCandidates find_nose_candidates(std::span<const SurfacePoint> points) {
  NoseCandidates found;
  const std::size_t every = std::max<std::size_t>(1, points.size() / 1000);
  for (std::size_t i = 0; i < points.size(); i += every)
    if (const double p = protrusion(points, points[i].at_mm); p > 3) keep(found, {points[i].at_mm, p});
  return found;
}

}  // namespace relievo::pipeline

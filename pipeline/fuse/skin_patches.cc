// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/skin_patches.h"

#include <algorithm>
#include <cmath>

#include "hal/base/statistics.h"

namespace relievo::pipeline {
namespace {

constexpr double kLeastScaleMm = 0.05;
constexpr double kPatchMm = 20;

}  // namespace

std::size_t SkinPatches::at(const Vec3d& in_head) {
  const auto cell = [](double x) {
    return static_cast<std::size_t>(
        std::clamp(static_cast<int>(std::floor(x / kPatchMm)) + kAcross / 2, 0, kAcross - 1));
  };
  return (cell(in_head.z + kHeadCentreMm) * kAcross + cell(in_head.y)) * kAcross + cell(in_head.x);
}

std::size_t SkinPatches::region_of(std::size_t patch) {
  const std::size_t x = patch % kAcross, y = patch / kAcross % kAcross, z = patch / kAcross / kAcross;
  return ((z / 2) * (kAcross / 2) + y / 2) * (kAcross / 2) + x / 2;
}

double SkinPatches::still(std::size_t patch, std::size_t a, std::size_t b) const {
  if (!watched()) return 1;
  const Sum& p = patches_[between(patch, a, b)];
  const double mean = p.weight > 0 ? static_cast<double>(p.sum / p.weight) : 0;
  const double kept = scale_mm_ * scale_mm_ / (scale_mm_ * scale_mm_ + mean * mean);
  return kept * kept;
}

void SkinPatches::add(Sums& sums, std::size_t patch, std::size_t a, std::size_t b, double value,
                      double weight) const {
  Sum& sum = sums[between(patch, a, b)];
  const double own = weight / std::max(still(patch, a, b), 1e-6);
  sum.sum += static_cast<float>(a < b ? own * value : -own * value);
  sum.weight += static_cast<float>(own);
}

void SkinPatches::take(const Sums& sums) {
  patches_ = sums;
  scale_mm_ = std::max(kLeastScaleMm, usual_mm());
}

std::size_t SkinPatches::between(std::size_t patch, std::size_t a, std::size_t b) const {
  return (patch * poses_ + std::min(a, b)) * poses_ + std::max(a, b);
}

double SkinPatches::usual_mm() const {
  std::pmr::vector<double> off(patches_.get_allocator());
  for (const Sum& p : patches_)
    if (p.weight > 0) off.push_back(std::abs(static_cast<double>(p.sum / p.weight)));
  return off.empty() ? 0 : median(off) / 0.6745;
}

}  // namespace relievo::pipeline

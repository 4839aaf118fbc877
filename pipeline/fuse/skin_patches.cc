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
    return std::size_t(std::clamp(int(std::floor(x / kPatchMm)) + kAcross / 2, 0, kAcross - 1));
  };
  return (cell(in_head.z + kHeadCentreMm) * kAcross + cell(in_head.y)) * kAcross + cell(in_head.x);
}

std::size_t SkinPatches::region_of(std::size_t patch) {
  const std::size_t x = patch % kAcross, y = patch / kAcross % kAcross, z = patch / kAcross / kAcross;
  return ((z / 2) * (kAcross / 2) + y / 2) * (kAcross / 2) + x / 2;
}

double SkinPatches::usual_mm(std::span<const PatchMean> means, std::pmr::memory_resource& memory) {
  std::pmr::vector<double> off(&memory);
  for (const PatchMean& m : means) off.push_back(std::abs(m.mm));
  return off.empty() ? 0 : median(off) / 0.6745;
}

// One that lies off by the scale keeps a quarter of its say.
double SkinPatches::still(double mean_mm, double usual_mm) {
  const double scale = std::max(kLeastScaleMm, usual_mm);
  const double kept = scale * scale / (scale * scale + mean_mm * mean_mm);
  return kept * kept;
}

void SkinPatches::take(std::span<const PatchMean> means) {
  mean_mm_.assign(kPatches * poses_ * poses_, 0.0F);
  for (const PatchMean& m : means) mean_mm_[between(m.patch, m.a, m.b)] = float(m.mm);
  usual_mm_ = usual_mm(means, *mean_mm_.get_allocator().resource());
}

}  // namespace relievo::pipeline

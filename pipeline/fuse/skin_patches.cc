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

// Where skin moves, a patch that was measured better says hardly more (random effects: DerSimonian, Laird
// 1986).
double SkinPatches::weight_of(const PatchMean& mean, double usual_mm) {
  return mean.weight / (1 + mean.weight * usual_mm * usual_mm);
}

double SkinPatches::say(const PatchMean& mean, double usual_mm) {
  return still(mean.mm, usual_mm) * weight_of(mean, usual_mm) / mean.weight;
}

void SkinPatches::take(std::span<const PatchMean> means) {
  usual_mm_ = usual_mm(means, *say_.get_allocator().resource());
  // Not robustly, as where the skulls stand is found: what moved is part of how unsure that is.
  double squares = 0, weights = 0;
  for (const PatchMean& m : means) {
    const double weight = weight_of(m, usual_mm_);
    squares += weight * m.mm * m.mm;
    weights += weight;
  }
  variance_mm2_ = weights > 0 ? squares / weights / 2 : 0;
  say_.assign(kPatches * poses_ * poses_, 1.0F);
  for (const PatchMean& m : means) say_[between(m.patch, m.a, m.b)] = float(say(m, usual_mm_));
}

}  // namespace relievo::pipeline

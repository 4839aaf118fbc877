// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Skin moves in patches of 20 mm: one whose mean lies off between two poses, by more than 0.05 mm and more
// than is usual, has moved, and loses its say in how the skull stands. Head frame. Memory: `scratch`. Thread:
// one caller.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/model/vector3.h"

namespace relievo::pipeline {

inline constexpr double kHeadCentreMm = 95;  // behind the tip of the nose

// How far the skin of one patch lies before that of another pose, in the mean: `a` before `b`, a < b.
struct PatchMean {
  std::size_t patch, a, b;
  double mm;
  double weight;  // 1 / mm^2, as measured
};

class SkinPatches {
 public:
  static constexpr int kAcross = 24;
  static constexpr std::size_t kPatches = std::size_t{kAcross} * kAcross * kAcross, kRegions = kPatches / 8;

  SkinPatches(std::size_t poses, std::pmr::memory_resource* scratch) : poses_(poses), say_(scratch) {}

  static std::size_t at(const Vec3d& in_head);
  // Skin moves in regions of two patches each way.
  static std::size_t region_of(std::size_t patch);
  // How far patches lie off, one standard deviation, robustly.
  static double usual_mm(std::span<const PatchMean> means, std::pmr::memory_resource& memory);
  // What a patch counts, as a share of its weight: less where it moved, and the less the better it was
  // measured.
  static double say(const PatchMean& mean, double usual_mm);

  void watch() { take({}); }
  bool watched() const { return !say_.empty(); }
  void take(std::span<const PatchMean> means);
  // 1 where nothing was said of a patch.
  double say(std::size_t patch, std::size_t a, std::size_t b) const {
    return double(say_[between(patch, a, b)]);
  }
  // Of a patch of one pose's skin, about where it should be: half of that between two poses.
  double variance_mm2() const { return variance_mm2_; }

 private:
  // How much a patch that lies so far off has to say, 0 to 1.
  static double still(double mean_mm, double usual_mm);
  static double weight_of(const PatchMean& mean, double usual_mm);
  std::size_t between(std::size_t patch, std::size_t a, std::size_t b) const {
    return (patch * poses_ + std::min(a, b)) * poses_ + std::max(a, b);
  }

  std::size_t poses_;
  std::pmr::vector<float> say_;
  double usual_mm_ = 0, variance_mm2_ = 0;
};

}  // namespace relievo::pipeline

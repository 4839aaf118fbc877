// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Skin moves in patches of 20 mm: one whose mean lies off between two poses, by more than 0.05 mm and more
// than is usual, has moved, and loses its say in how the skull stands. Head frame. Memory: `scratch`. Thread:
// one caller.
#pragma once

#include <cstddef>
#include <memory_resource>
#include <vector>

#include "pipeline/model/vector3.h"

namespace relievo::pipeline {

inline constexpr double kHeadCentreMm = 95;  // behind the tip of the nose

class SkinPatches {
 public:
  static constexpr int kAcross = 24;
  static constexpr std::size_t kPatches = std::size_t{kAcross} * kAcross * kAcross, kRegions = kPatches / 8;
  struct Sum {
    float sum = 0, weight = 0;
  };
  using Sums = std::pmr::vector<Sum>;

  SkinPatches(std::size_t poses, std::pmr::memory_resource* scratch) : poses_(poses), patches_(scratch) {}

  static std::size_t at(const Vec3d& in_head);
  // Skin moves in regions of two patches each way.
  static std::size_t region_of(std::size_t patch);

  void watch() { patches_.assign(kPatches * poses_ * poses_, Sum{}); }
  bool watched() const { return !patches_.empty(); }
  // How much a patch has to say between two poses, 0 to 1; 1 before it is watched.
  double still(std::size_t patch, std::size_t a, std::size_t b) const;
  // Of a patch of one pose's skin, about where it should be: half of that between two poses, robustly.
  double variance_mm2() const { return usual_mm() * usual_mm() / 2; }

  // The patches are looked at anew: every residual is added to no_sums(), then they take these.
  Sums no_sums() const { return Sums(patches_.size(), Sum{}, patches_.get_allocator()); }
  // `value` is by how much `a` lies before `b`, `weight` what it counts by still() and all else.
  void add(Sums& sums, std::size_t patch, std::size_t a, std::size_t b, double value, double weight) const;
  void take(const Sums& sums);

 private:
  std::size_t between(std::size_t patch, std::size_t a, std::size_t b) const;
  // How far patches lie off between two poses, one standard deviation, robustly.
  double usual_mm() const;

  std::size_t poses_;
  Sums patches_;
  double scale_mm_ = 0.05;  // one that lies off by this keeps a quarter of its say
};

}  // namespace relievo::pipeline

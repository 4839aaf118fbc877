// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How firmly SurfaceRefiner holds each node flat: the weights of the second differences in BendingSystem.
//
//   omega = lambda / (1 + (bend / crease)^2 + min(kMostWrinkled, max(0, mean of min(kSharpest, (bend /
//   wrinkle)^2) - kPlain)))
//
// A single sharp bend is a crease (an eyelid, a nostril) and let go: a Cauchy prior by reweighting, as in
// Charbonnier et al. 1997. A patch of 17 x 17 nodes (9 mm: waves of 6 mm and more) that bends everywhere is a
// relief (wrinkles, lips) and held less, too, yet never let go. The patch is that large, and what noise alone
// bends plain skin is taken off, so that no noise takes itself for relief and runs away; a crease, however
// sharp, speaks for its own node only. Thread: any; bands of rows on the pool.
#pragma once

#include <cstdint>

#include "hal/base/thread_pool.h"
#include "pipeline/match/bending/bending_system.h"
#include "pipeline/match/image/plane.h"

namespace relievo::pipeline {

inline constexpr float kMostWrinkled = 8, kSharpest = 12, kPlain = 3;  // of (bend / wrinkle)^2

struct BendingExpectation {
  double lambda;   // weight of a squared second difference of nodes
  double crease;   // of second differences, in the disparity's unit
  double wrinkle;  // likewise; 0: a neighbourhood's bends say nothing
};

// Writes bend_xx, bend_yy and bend_xy of the system, and to `wrinkled` the last term above. `across` is
// scratch.
void weigh_bending(const Plane<float>& d, const Plane<std::uint8_t>& domain,
                   const BendingExpectation& expected, ThreadPool& pool, Plane<float>& across,
                   Plane<float>& wrinkled, BendingSystem& system);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The linear system of SurfaceRefiner: (diag(A) + D' W D) x = b, where D takes the second differences
// xx, yy and xy of a field over a lattice and W weighs them. Solved by conjugate gradients,
// preconditioned on several lattices (multilevel_preconditioner.h); reductions run in a fixed order, so that
// the bytes do not depend on the pool. Thread: one caller; apply_system: any, on rows of its own.
#pragma once

#include <cstdint>
#include <memory_resource>

#include "hal/base/thread_pool.h"
#include "pipeline/match/image/plane.h"

namespace relievo::pipeline {

struct BendingSystem {
  BendingSystem(std::pmr::memory_resource* memory, int width, int height) : shape{memory, width, height} {}
  PlaneShape shape;
  Plane<float> data{shape};     // A; 0 where nothing was measured
  Plane<float> bend_xx{shape};  // weight of x[-1] - 2 x + x[+1]; 0 where a neighbour is missing
  Plane<float> bend_yy{shape};
  Plane<float> bend_xy{shape};  // weight of the cell whose upper left corner this is
  Plane<float> rhs{shape};

  int width() const { return shape.width; }
  int height() const { return shape.height; }
};

// out = (A + D'WD) x for rows [begin, end), or D'WD x without the data. The outermost nodes are never
// written. `rolling` is scratch for rolling_floats(width) numbers.
constexpr int rolling_floats(int width) { return 10 * width; }
void apply_system(const BendingSystem& system, const Plane<float>& x, bool with_data, Plane<float>& out,
                  int begin, int end, float* rolling);

// x, of the system's size and whatever it holds, becomes the solution: from 0, in at most `steps` steps of
// conjugate gradients, and in fewer when the residual's squared norm, as the preconditioner sees it, has
// fallen to `tolerance` of what it was at 0. Takes about 8 1/3 such planes of `scratch`. Throws
// std::bad_alloc.
void solve(const BendingSystem& system, int steps, double tolerance, ThreadPool& pool,
           std::pmr::memory_resource& scratch, Plane<float>& x);

inline constexpr double kToTheEnd = 1e-7;  // what single precision gives

// How firmly SurfaceRefiner holds each node flat: the weights of the second differences in BendingSystem.
//
//   omega = lambda / (1 + (bend / crease)^2 + min(kMostWrinkled, max(0, mean of min(kSharpest, (bend /
//   wrinkle)^2) - kPlain)))
//
// A single sharp bend is a crease (an eyelid, a nostril) and let go: a Cauchy prior by reweighting, as in
// Charbonnier et al. 1997. A patch of 17 x 17 nodes (9 mm: waves of 6 mm and more) that bends everywhere is a
// relief (wrinkles, lips) and held less, yet never let go. The patch is that large, and what noise alone
// bends is taken off, so that no noise takes itself for relief; a crease speaks for its own node only.
inline constexpr float kMostWrinkled = 8, kSharpest = 12, kPlain = 3;  // of (bend / wrinkle)^2

struct BendingExpectation {
  double lambda;   // weight of a squared second difference of nodes
  double crease;   // of second differences, in the disparity's unit
  double wrinkle;  // likewise; 0: a neighbourhood's bends say nothing
};

// Writes bend_xx, bend_yy and bend_xy, and to `wrinkled` the last term above. `across` is scratch.
void weigh_bending(const Plane<float>& d, const Plane<std::uint8_t>& domain,
                   const BendingExpectation& expected, ThreadPool& pool, Plane<float>& across,
                   Plane<float>& wrinkled, BendingSystem& system);

}  // namespace relievo::pipeline

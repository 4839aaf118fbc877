// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The linear system of SurfaceRefiner: (diag(A) + D' W D) x = b, where D takes the second differences
// xx, yy and xy of a field over a lattice and W weighs them. Solved by conjugate gradients,
// preconditioned on several lattices (multilevel_preconditioner.h); reductions run in a fixed order, so that
// the bytes do not depend on the pool. Thread: one caller; apply_system: any, on rows of its own.
#pragma once

#include <memory_resource>

#include "hal/base/thread_pool.h"
#include "pipeline/match/image/plane.h"

namespace relievo::pipeline {

struct BendingSystem {
  BendingSystem(std::pmr::memory_resource* memory, int width, int height)
      : data(memory, width, height),
        bend_xx(memory, width, height),
        bend_yy(memory, width, height),
        bend_xy(memory, width, height),
        rhs(memory, width, height) {}
  Plane<float> data;     // A; 0 where nothing was measured
  Plane<float> bend_xx;  // weight of x[-1] - 2 x + x[+1]; 0 where a neighbour is missing
  Plane<float> bend_yy;
  Plane<float> bend_xy;  // weight of the cell whose upper left corner this is
  Plane<float> rhs;

  int width() const { return data.width; }
  int height() const { return data.height; }
};

// out = (A + D'WD) x for rows [begin, end), or D'WD x without the data. The outermost nodes are never
// written. `rolling` is scratch for rolling_floats(width) numbers.
constexpr int rolling_floats(int width) { return 10 * width; }
void apply_system(const BendingSystem& system, const Plane<float>& x, bool with_data, Plane<float>& out,
                  int begin, int end, float* rolling);

// x, of the system's size and whatever it holds, becomes the solution: from 0, in at most `steps` steps of
// conjugate gradients, and in fewer when the residual's squared norm, as the preconditioner sees it, has
// fallen to `tolerance` of what it was at 0. Takes about 8 1/3 planes of the system's size from `scratch`.
// Throws std::bad_alloc.
void solve(const BendingSystem& system, int steps, double tolerance, ThreadPool& pool,
           std::pmr::memory_resource& scratch, Plane<float>& x);

inline constexpr double kToTheEnd = 1e-7;  // what single precision gives

}  // namespace relievo::pipeline

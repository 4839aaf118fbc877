// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The linear system of refine_surface(): (diag(A) + D' W D) x = b, where D takes the second differences
// xx, yy and xy of a field over a lattice and W weighs them. Solved by conjugate gradients,
// preconditioned on several lattices (MultilevelPreconditioner); reductions run in a fixed order, so that
// the bytes do not depend on the pool. Thread: one caller; apply_system: any, on rows of its own.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

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

// How firmly refine_surface() holds each node flat: the weights of the second differences in BendingSystem.
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

// Where the surface may fold: 0 nowhere, 255 surely. The folds' lines lead along y in `xx`, along x in `yy`.
// There 1 + ... becomes kFolded more for the second differences that cross the line, and those along it stay
// held; the mixed one has the geometric mean of both. A groove that is hardly wider than the lattice's nodes
// is known from its whole length, and so bends where the prior for skin, alike in all directions, would
// smooth it away.
inline constexpr float kFolded = 100;  // as much as a crease of ten times the expected bend

struct Folds {
  Folds(std::pmr::memory_resource* memory, int width, int height)
      : xx(memory, width, height), yy(memory, width, height) {}
  Plane<std::uint8_t> xx, yy;
};

// Writes bend_xx, bend_yy and bend_xy, and to `wrinkled` the last term above. `across` is scratch.
void weigh_bending(const Plane<float>& d, const Plane<std::uint8_t>& domain,
                   const BendingExpectation& expected, const Folds& folds, ThreadPool& pool,
                   Plane<float>& across, Plane<float>& wrinkled, BendingSystem& system);

// ColumnSpan: columns of a row from `begin` up to `end`; none where they are equal.
struct ColumnSpan {
  int begin, end;
};

// MultilevelPreconditioner of a BendingSystem: the sum, over lattices that each halve the one before, of what
// every one makes of the residual by its own diagonal (Bramble, Pasciak, Xu, Parallel multilevel
// preconditioners, 1990). Where skin says little, what it says spreads over many nodes, and the diagonal
// alone would take as many steps to carry it there. Between lattices go quadratic B-splines: their second
// differences stay bounded, which bilinear ones' do not. The operator it applies is symmetric and positive on
// the nodes the system knows, and 0 elsewhere. Memory: it keeps about 1 2/3 planes of the system's size;
// while it is made it takes 2 2/3 more from `memory`, which an arena has back with its next mark. Thread: one
// caller; its bands are fixed, so that results do not depend on the pool. Throws std::bad_alloc.
class MultilevelPreconditioner {
 public:
  MultilevelPreconditioner(const BendingSystem& system, ThreadPool& pool, std::pmr::memory_resource* memory);

  // z = M r; `spans`, a row of the system each, holds all of r that is not 0 and is all of z that is written.
  // The outermost rows and columns of r are 0.
  void apply(const Plane<float>& r, const std::pmr::vector<ColumnSpan>& spans, Plane<float>& z);

 private:
  struct Level {
    Level(std::pmr::memory_resource* memory, int width, int height)
        : inverse_diagonal(memory, width, height), value(memory, width, height) {}
    Plane<float> inverse_diagonal;
    Plane<float> value;  // the residual as this lattice sees it, then what it and all coarser ones make of it
  };
  void add_levels(const BendingSystem& system, std::pmr::memory_resource* memory);
  void restrict_to(const Plane<float>& fine, Plane<float>& coarse);

  ThreadPool& pool_;
  Plane<float> inverse_diagonal_;  // of the system itself
  std::pmr::vector<Level> levels_;
  Plane<float> lines_;  // a line a band
  Plane<float> zeros_;  // a row beyond a lattice's ends
};

}  // namespace relievo::pipeline

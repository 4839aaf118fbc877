// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// MultilevelPreconditioner of a BendingSystem: the sum, over lattices that each halve the one before, of what
// every one makes of the residual by its own diagonal (Bramble, Pasciak, Xu, Parallel multilevel
// preconditioners, 1990). Where skin says little, what it says spreads over many nodes, and the diagonal
// alone would take as many steps to carry it there. Between lattices go quadratic B-splines: their second
// differences stay bounded, which bilinear ones' do not. The operator it applies is symmetric and positive on
// the nodes the system knows, and 0 elsewhere. Memory: it keeps about 1 2/3 planes of the system's size;
// while it is made it takes 2 2/3 more from `memory`, which an arena has back with its next mark. Thread: one
// caller; its bands are fixed, so that results do not depend on the pool. Throws std::bad_alloc.
#pragma once

#include <memory_resource>
#include <vector>

#include "hal/base/thread_pool.h"
#include "pipeline/match/bending/bending_system.h"

namespace relievo::pipeline {

// ColumnSpan: columns of a row from `begin` up to `end`; none where they are equal.
struct ColumnSpan {
  int begin, end;
};

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
  void finish_level(std::size_t level);

  ThreadPool& pool_;
  Plane<float> inverse_diagonal_;  // of the system itself
  std::pmr::vector<Level> levels_;
  Plane<float> lines_;  // a line a band
  Plane<float> zeros_;  // a row beyond a lattice's ends
};

}  // namespace relievo::pipeline

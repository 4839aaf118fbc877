// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lays a lattice's surface on another lattice, finer or coarser by any factor, so that a face has as many
// triangles as it may have however near it stood. A new node lies on the old surface: where all of its
// neighbourhood is surface on the cubic through 4 x 4 nodes (Keys 1981, a = -1/2), which does not flatten
// what is curved between nodes, else on its cell or triangle. A new triangle is made only where the old
// surface lies under all of it: no hole is filled, no step bridged, nothing put beyond the old edges. The new
// cells may grow towards the lattice's edges, where a face's crop holds hair, neck and cheeks seen askew.
#pragma once

#include <memory_resource>
#include <optional>

#include "hal/base/thread_pool.h"
#include "pipeline/mesh/lattice/cell_mask.h"
#include "pipeline/mesh/lattice/lattice_surface.h"

namespace relievo::pipeline {

struct ShapedLattice {
  PointLattice lattice;
  CellMask inside;  // what lies within the outline, holes included
  // Of a closed face: what was completed may lie where the view does not see it, nothing beyond this is kept.
  std::optional<FaceOutline> outline{};
};

struct LatticeSpacing {
  float cells = 1;  // a new cell's width in old ones, about the middle; above 0
  float edge = 1;   // how many times wider it is at the edges; 1 or more
};

// About how many triangles a lattice of cells as wide as the old ones, and so much wider at the edges, has of
// this surface.
double expected_triangles(const ShapedLattice& old, float edge);

// Throws std::bad_alloc when `memory` is used up.
ShapedLattice resample_lattice(const ShapedLattice& old, const LatticeSpacing& spacing, float max_slope,
                               ThreadPool& pool, std::pmr::memory_resource* memory);

// Lays it on a head's chart, about as fine, with room around what there is: nodes alone, join_neighbours()
// joins them. Throws std::bad_alloc when `memory` is used up.
PointLattice lay_on_head(const PointLattice& old, const HeadChart& chart, float margin_mm, ThreadPool& pool,
                         std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline

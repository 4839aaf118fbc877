// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lays a lattice's surface on another lattice, finer or coarser by any factor, so that a face has as many
// triangles as it may have however near it stood. A new node lies on the old surface: where all of its
// neighbourhood is surface on the cubic through 4 x 4 nodes (Keys 1981, a = -1/2), which does not flatten
// what is curved between nodes, else on its cell or triangle. A new triangle is made only where the old
// surface lies under all of it: no hole is filled, no step bridged, nothing put beyond the old edges.
#pragma once

#include <memory_resource>

#include "pipeline/mesh/lattice/cell_mask.h"
#include "pipeline/mesh/lattice/lattice_surface.h"

namespace relievo::pipeline {

struct ShapedLattice {
  PointLattice lattice;
  LatticeSurface surface;
  CellMask inside;  // what lies within the outline, holes included
};

// `spacing` in cells of the old lattice, above 0. Throws std::bad_alloc when `memory` is used up.
ShapedLattice resample_lattice(const ShapedLattice& old, float spacing, float max_slope, std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline

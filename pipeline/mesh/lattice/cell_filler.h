// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fills cells of a lattice that carry no surface, or half of one: nodes that no triangle holds are put
// where a thin plate through the surface around them has them (inside a gap it bridges, beyond an outline
// it goes on straight), become Node::Filled, with twice the sigma usual around them; then the cells are
// cut, but for those that would be steeper than `max_slope`. Throws std::bad_alloc when `memory` is used up.
#pragma once

#include <atomic>
#include <memory_resource>
#include <span>

#include "pipeline/mesh/lattice/cell_mask.h"
#include "pipeline/mesh/lattice/lattice_surface.h"

namespace relievo::pipeline {

// `wanted`: which; they must not touch the last column and row. `like`: empty, or on a head's chart the radii
// of another surface, mm, 0 where nothing is known of it: the plate bends as that does. Once `cancelled` is
// set, what is filled is not finished: the caller throws it away.
void fill_cells(PointLattice& lattice, const CellMask& wanted, float max_slope, std::span<const double> like,
                std::pmr::memory_resource* memory, const std::atomic<bool>* cancelled = nullptr);

}  // namespace relievo::pipeline

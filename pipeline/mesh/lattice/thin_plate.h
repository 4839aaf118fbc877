// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Thin plate: puts free nodes of a lattice where the surface through them bends least, so that a closed
// gap continues the curvature on its sides and a hole on a cheek does not become a dimple. The energy is
// the sum of squared second differences (xx, yy and twice xy) over known and free nodes; where free nodes
// lie at the edge of what is known it is linear there (natural boundary). Least squares by conjugate
// gradients (CGLS; Hestenes, Stiefel 1952; Terzopoulos 1988 for the energy). Millimetres.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>

#include "pipeline/mesh/lattice/point_lattice.h"

namespace relievo::pipeline {

// Moves lattice.at_mm of the `free` nodes, which must be joined to known ones through neighbours; `known`
// has one byte a node. A free node is none of the known. Throws std::bad_alloc when `memory` is used up.
void relax_thin_plate(PointLattice& lattice, std::span<const std::uint32_t> free, std::span<const std::uint8_t> known,
                      std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline

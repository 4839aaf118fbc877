// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closes gaps of a lattice's surface: holes, and cracks of any length, wherever they are narrow and both
// sides continue each other. What is narrow is decided by a closing with a disc (Serra 1982), then in
// millimetres of space from rim to rim; what continues, by the slope of the shortest bridge, which may
// leave the slopes on its two sides by little. An occlusion edge (the side of a nose, a nostril) fails
// and stays open, and so does whatever would be steeper than the surface may be.
#pragma once

#include <cstddef>
#include <memory_resource>

#include "pipeline/mesh/lattice/cell_mask.h"
#include "pipeline/mesh/lattice/lattice_surface.h"

namespace relievo::pipeline {

struct GapLimits {
  float max_width_mm = 0;  // from rim to rim
  float max_slope = 0;     // tangent of the steepest angle of incidence
  float max_bend = 0;      // tangent of how far a bridge's slope may leave that of both sides ...
  float min_step_mm = 0;   // ... once it has left it by so many millimetres
};

// Closed cells get a thin plate (their new nodes become Node::Filled, with twice the rim's sigma). Specks
// of surface smaller than the widest gap are taken for part of the gap; pinholes that noise leaves
// in a bridge are laid anew with what lies around them. Throws std::bad_alloc when `memory` is used up.
void close_gaps(PointLattice& lattice, const GapLimits& limits, MaskShaper& shaper,
                std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline

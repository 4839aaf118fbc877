// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The outline of a lattice's surface, found in four steps, the first three blind to holes inside, whose
// surroundings stay as they are:
//   the rim   surface that turns away from the camera and leads to the outside goes: the last rows before
//             the horizon are measured worst, and left standing they are a fringe of teeth and flags;
//   strips    whatever a disc of min_width_mm does not fit into goes (an opening; Serra 1982);
//   waves     the line of a cheek's steepest surface swings in and out: it is straightened (a Gaussian of
//             wave_mm over what is in). Bays are filled with what was measured there, where it continues
//             the surface, else with its smooth continuation (Node::Filled); tongues are cut;
//   nicks     a hole that stayed open a few millimetres from the outside (between strands of hair) goes with
//   what
//             lies around it: the outline passes within it, in a bow no narrower than a disc of
//             min_width_mm's radius.
#pragma once

#include <memory_resource>

#include "pipeline/mesh/lattice/cell_mask.h"
#include "pipeline/mesh/lattice/lattice_surface.h"

namespace relievo::pipeline {

struct OutlineLimits {
  float max_slope = 0;      // tangent of the steepest angle of incidence
  float max_rim_slope = 0;  // tangent of the steepest angle of incidence before the outside, seen from:
  Vec3f from_mm{};
  float min_width_mm = 0;
  float wave_mm = 0;  // sigma of the straightening
};

// Empties the cells beyond, fills bays; returns what lies inside, holes included. Throws std::bad_alloc when
// `memory` is used up.
CellMask trim_outline(PointLattice& lattice, const OutlineLimits& limits, MaskShaper& shaper,
                      std::pmr::memory_resource* memory);

// Cells whose surface, averaged over about 1.5 mm, is steeper than this tangent to the line of sight from a
// place.
CellMask steep_cells(const PointLattice& lattice, float max_slope, const Vec3f& from_mm,
                     std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lays the left view's lattice on that of the view half way between the cameras, row by row: what both saw turns away
// from it least, and what one alone saw is a gap with a width, on either side of a nose, that a surface can be laid over.
// A new node lies on the cubic through four neighbours of its row (Keys 1981, a = -1/2) where they continue one
// surface, else on the straight line between two; where surface stands before surface the nearer one counts.
#pragma once

#include <memory_resource>

#include "pipeline/mesh/lattice/lattice_surface.h"

namespace relievo::pipeline {

// `margin_mm`: so much room is left around what was measured. Throws std::bad_alloc when `memory` is used up.
PointLattice lay_in_middle_view(const PointLattice& left, const MiddleView& view, const LatticeLimits& limits, float margin_mm,
                                std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline

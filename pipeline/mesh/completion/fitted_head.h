// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The head of a family (generic_head.h) that fits best what was measured of one: ridge regression of the
// modes' weights on radii, rounds of Huber's weights against hair, a tongue, a hand. `misfit_mm`: what a
// person differs by from all that the family can be, one standard deviation. Throws std::bad_alloc. Thread:
// any.
#pragma once

#include <memory_resource>
#include <vector>

#include "pipeline/mesh/completion/unrolled_head.h"

namespace relievo::pipeline {

// Radii over the unrolled head's cells; NaN below the jaw.
FaceRelief fit_generic_face(const UnrolledHead& head, double cell_mm, double misfit_mm);

// At the nodes of the generic head's globe; the sigma is the posterior's, with what the family cannot show.
struct FittedGlobe {
  std::pmr::vector<double> radius_mm, sigma_mm;
};
FittedGlobe fit_generic_globe(const UnrolledHead& head, double cell_mm, double misfit_mm,
                              std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline

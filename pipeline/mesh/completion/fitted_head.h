// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The head of a family (generic_head.h) that fits best what was measured of one: ridge regression of the
// modes' weights on radii, rounds of Huber's weights against hair, a tongue, a hand. Thread: any.
#pragma once

#include "pipeline/mesh/completion/unrolled_head.h"

namespace relievo::pipeline {

// Over the unrolled head's cells; radii are NaN below the jaw.
struct FittedHead {
  FaceRelief radius, sigma;
};

// `misfit_mm`: what a person differs by from all that the family can be, one standard deviation. Throws
// std::bad_alloc.
FittedHead fit_generic_head(const UnrolledHead& head, double cell_mm, double misfit_mm);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Looks for the surface once more by its fine detail. A highlight lies at another depth than the skin it
// shines on, and on dark or even skin it is all that a small picture shows: the coarse matching follows it,
// by several pixels at the tip of a nose, too far for refinement to find back. Pores do not: of both views
// only what is finer than a few pixels is kept, and where that agrees clearly better some pixels to the
// side, correlated over a window that is still smaller than a nose, the field is moved there.
// Memory: scratch only. Results do not depend on the number of threads. Thread: any.
#pragma once

#include "pipeline/match/refine/surface_refiner.h"

namespace relievo::pipeline {

// Moves field.disparity_px where another place is clearly better, and says whether it did. The field's nodes
// must be the scene's pixels.
bool search_by_detail(const RefinerScene& scene, StageContext& context, SurfaceField& field);

}  // namespace relievo::pipeline

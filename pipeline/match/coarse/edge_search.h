// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Looks once more, at half the size and over the depths of the face alone, for what a smooth field passes by.
// From the side of a nose to the cheek and from the chin to the throat the disparity jumps by more than
// refinement finds back over, and at a quarter of the size the rims themselves are hardly two pixels wide.
// Where semi-global matching of half the size disagrees with the field by more than a pixel and a half over a
// whole window, the field is set anew; what it finds in one surface with the face beside the field is added
// to it. Memory: scratch, by the box of the field: a third of a picture's. Results do not depend on the
// number of threads. Thread: any.
#pragma once

#include "pipeline/match/coarse/coarse_surface.h"

namespace relievo::pipeline {

// `field` is a lattice over the pixels of level 1 (step 2) that knows the face. Errors: Cancelled.
Result<void> search_edges(const RectifiedPair& pair, const Pyramids& pyramids,
                          const CoarseSurfaceOptions& options, StageContext& context, SurfaceField& field);

}  // namespace relievo::pipeline

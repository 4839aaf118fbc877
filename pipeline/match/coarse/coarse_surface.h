// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rough field from which refinement starts: semi-global matching over the whole volume on
// pictures an eighth of the size, then in a narrow band at a quarter, cross-checked between the
// views, and the one connected surface that is the face.
#pragma once

#include "pipeline/base/stage.h"
#include "pipeline/match/coarse/semi_global.h"
#include "pipeline/match/image/image_pyramid.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

struct CoarseSurfaceOptions {
  int band = 12;                // candidates around the prediction at the finer level
  float cross_check_px = 1.5F;  // in pixels of the finer level
  int largest_hole = 600;       // pixels of the finer level: enclosed holes up to this size are bridged
};

inline constexpr int kCoarseLevel = 3;
inline constexpr int kFineLevel = 2;

// No face was looked for: every surface is wanted, not one.
inline bool is_scene(const RectifiedPair& pair) { return pair.region.empty(); }

// `field` is a lattice over the pixels of level 2 (step 4), or of level 1 (step 2; a scene needs it for its
// thin parts); its domain is what was found: the region's largest surface, all but specks of a scene. Errors:
// TooFewMatches, Cancelled.
Result<void> find_coarse_surface(const RectifiedPair& pair, const Pyramids& pyramids,
                                 const CoarseSurfaceOptions& options, StageContext& context,
                                 SurfaceField& field);

// Looks once more, at half the size and over the depths of the face alone, for what a smooth field passes by.
// From the side of a nose to the cheek and from the chin to the throat the disparity jumps by more than
// refinement finds back over, and at a quarter of the size the rims themselves are hardly two pixels wide.
// Where semi-global matching of half the size disagrees with the field by more than a pixel and a half over a
// whole window, the field is set anew; what it finds in one surface with the face beside the field is added
// to it. `field` is a lattice over the pixels of level 1 (step 2) that knows the face. Memory: scratch, a
// third of a whole picture's. Results do not depend on the number of threads. Thread: any. Errors: Cancelled.
Result<void> search_edges(const RectifiedPair& pair, const Pyramids& pyramids,
                          const CoarseSurfaceOptions& options, StageContext& context, SurfaceField& field);

// Bridges smoothly the holes that the surface encloses, so that refinement can look there: highlights and
// plain skin fail the cross-check and may still be found from their surroundings. What the finer pictures do
// not confirm keeps a large sigma and goes; what is hidden from the right view breaks the uniqueness rule and
// goes. `usable`: where a hole may lie, `largest`: nodes it may have; a hole at the rim of the picture, or
// beside what is not usable, is open and stays. Thread: any.
void bridge_holes(const Plane<std::uint8_t>& usable, int largest, Plane<std::uint8_t>& domain,
                  Plane<float>& disparity, std::pmr::memory_resource& scratch);

}  // namespace relievo::pipeline

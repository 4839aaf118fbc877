// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rough field from which refinement starts: semi-global matching over the whole volume on
// pictures an eighth of the size, then in a narrow band at a quarter, cross-checked between the
// views, and the one connected surface that is the face.
#pragma once

#include "pipeline/base/stage.h"
#include "pipeline/match/coarse/semi_global.h"
#include "pipeline/match/image/pyramids.h"
#include "pipeline/match/image/surface_field.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

struct CoarseSurfaceOptions {
  SemiGlobalCosts costs;
  int band = 12;                // candidates around the prediction at the finer level
  float cross_check_px = 1.5F;  // in pixels of the finer level
  int largest_hole = 600;       // pixels of the finer level: enclosed holes up to this size are bridged
  float step_limit_px = 1.5F;   // neighbours further apart belong to different surfaces
};

inline constexpr int kCoarseLevel = 3;
inline constexpr int kFineLevel = 2;

// No face was looked for: every surface is wanted, not one.
inline bool is_scene(const RectifiedPair& pair) { return pair.region.empty(); }

// `field` is a lattice over the pixels of level 2 (step 4), or of level 1 (step 2; a scene needs it for its
// thin parts); its domain is what was found: the largest surface of the region, or of a scene all that are no
// specks. Errors: TooFewMatches, Cancelled.
Result<void> find_coarse_surface(const RectifiedPair& pair, const Pyramids& pyramids,
                                 const CoarseSurfaceOptions& options, StageContext& context,
                                 SurfaceField& field);

}  // namespace relievo::pipeline

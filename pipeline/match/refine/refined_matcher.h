// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RefinedMatcher ("refined", the default): coarse semi-global matching blind to exposure, then one
// least-squares surface over the whole face, refined from a quarter of the size to full size.
// See semi_global.h and surface_refiner.h. sigma_px is the posterior of the fit, more where skin
// mirrors lamps (RectifiedView::mirrored); cost is one minus the local correlation of the warped views.
// Keypoints may lie anywhere; on DenseSelector's lattice no interpolation is needed.
#pragma once

#include <memory_resource>

#include "pipeline/base/kinds.h"
#include "pipeline/base/options.h"
#include "pipeline/match/coarse/semi_global.h"
#include "pipeline/match/refine/surface_refiner.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// A small picture of a scene (no face was looked for) is matched at twice its size: semi-global matching then
// sees every pixel, not every second one, and a bar six pixels wide is no longer taken for its neighbour.
// Cubic between pixels (Keys 1981, a = -1/2), each new one a quarter of a pixel off an old one, so that all
// are equally sharp. Memory: the one given. Thread: any. Throws std::bad_alloc.

// Whether a pair is one: as large as may be matched at twice its size in the memory there is for a face.
bool is_small_scene(const RectifiedPair& pair);

// Grey values and what is valid; colours are left behind.
RectifiedPair enlarge(const RectifiedPair& pair, std::pmr::memory_resource* memory);
Keypoints enlarge(const Keypoints& keypoints, std::pmr::memory_resource* memory);

// What was found of an enlarged pair, in the pixels of the pair itself, whose lattice has this step.
void shrink(MatchSet& matches, int lattice_step_px);

struct RefinedMatcher {
  CoarseSurfaceOptions coarse;
  SurfaceRefinerOptions refiner;
  float sigma_limit_px = 1.9F;    // a place less certain than this has no match
  float align_beyond_px = 0.03F;  // the rows are realigned on the face itself where they disagree by more
  int follow_motion = 1;          // whether what moved across the rows between the exposures is followed

  void describe(auto&& field) {
    field("bending", refiner.bending, OptionRange{0.005, 5},
          "how strongly a face is expected to bend; less is smoother");
    field("crease", refiner.crease, OptionRange{0.05, 100},
          "second differences beyond this many expected ones count as creases");
    field("wrinkle", refiner.wrinkle, OptionRange{0, 100},
          "at full size, patches that bend beyond this many expected ones count as relief; 0: none do");
    field("local_window_px", refiner.local_window_px, OptionRange{5, 127},
          "window over which offset and gain between the views are constant");
    field("steps", refiner.steps, OptionRange{1, 32},
          "warps at full size; at a half one less, at a quarter twice that");
    field("solver_steps", refiner.solver_steps, OptionRange{1, 1000}, "conjugate-gradient steps a warp");
    field("sigma_limit_px", sigma_limit_px, OptionRange{0.01, 10},
          "a place less certain than this has no match");
    field("align_beyond_px", align_beyond_px, OptionRange{0, 1000},
          "rows of the two views that disagree by more are realigned on the face");
    field("follow_motion", follow_motion, OptionRange{0, 1},
          "1: what moved across the rows between the two exposures is followed");
    field("band", coarse.band, OptionRange{4, 64}, "disparities tried around the coarse prediction");
    field("largest_hole", coarse.largest_hole, OptionRange{0, 100000},
          "enclosed holes up to this many pixels, at a quarter of the size, are bridged for refinement");
    field("cross_check_px", coarse.cross_check_px, OptionRange{0.25, 16},
          "how far the two views may disagree, pixels at a quarter of the size");
  }
  Result<MatchSet> match(const RectifiedPair& pair, const Keypoints& keypoints, StageContext& context) const;
};

}  // namespace relievo::pipeline

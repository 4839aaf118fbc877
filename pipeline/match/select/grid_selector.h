// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// GridSelector ("grid-points"): a keypoint every step_px pixels of a rectangle of the left rectified view,
// from its upper left corner on, as far as it lies in the face region; the dissertation's PatternGrid.
// lattice_step_px is set: neighbourhoods are kept.
// Errors: InvalidInput (no pixels; a rectangle that leaves the view), NoFace (nothing in the region),
// OutOfMemory, Cancelled.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/kinds.h"

namespace relievo::pipeline {

struct GridSelector {
  int step_px = 8;
  int left_px = 0, top_px = 0;      // the rectangle's corner
  int width_px = 0, height_px = 0;  // 0: to the view's edge

  void describe(auto&& field) {
    field("step_px", step_px, OptionRange{1, 256}, "distance between keypoints, pixels");
    field("left_px", left_px, OptionRange{0, 8191},
          "left edge of the rectangle, pixels of the left rectified view");
    field("top_px", top_px, OptionRange{0, 8191},
          "upper edge of the rectangle, pixels of the left rectified view");
    field("width_px", width_px, OptionRange{0, 8192},
          "width of the rectangle, pixels; 0: to the view's edge");
    field("height_px", height_px, OptionRange{0, 8192},
          "height of the rectangle, pixels; 0: to the view's edge");
  }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const;
};

}  // namespace relievo::pipeline

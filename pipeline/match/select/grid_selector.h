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
#include "pipeline/match/keypoint_selector.h"

namespace relievo::pipeline {

struct GridSelectorOptions {
  int step_px = 8;
  int left_px = 0, top_px = 0;      // the rectangle's corner
  int width_px = 0, height_px = 0;  // 0: to the view's edge
  Result<void> check() const;
};

template <typename Field>
void describe(GridSelectorOptions& o, Field&& field) {
  field("step_px", o.step_px, OptionRange{1, 256}, "distance between keypoints, pixels");
  field("left_px", o.left_px, OptionRange{0, 8191},
        "left edge of the rectangle, pixels of the left rectified view");
  field("top_px", o.top_px, OptionRange{0, 8191},
        "upper edge of the rectangle, pixels of the left rectified view");
  field("width_px", o.width_px, OptionRange{0, 8192},
        "width of the rectangle, pixels; 0: to the view's edge");
  field("height_px", o.height_px, OptionRange{0, 8192},
        "height of the rectangle, pixels; 0: to the view's edge");
}

class GridSelector final : public KeypointSelector {
 public:
  explicit GridSelector(const GridSelectorOptions& options) : options_(options) {}
  std::string_view name() const override { return "grid-points"; }
  bool on_lattice() const override { return true; }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const override;

 private:
  GridSelectorOptions options_;
};

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// GridSelector ("grid"): a keypoint every step_px pixels inside the face region; the dissertation's
// PatternGrid. Where that would be more than max_points the step grows until it is not.
// lattice_step_px is set: neighbourhoods are kept.
// Errors: InvalidInput (no pixels), NoFace (an empty region), OutOfMemory, Cancelled.
#pragma once

#include "pipeline/match/keypoint_selector.h"
#include "pipeline/options.h"

namespace relievo::pipeline {

struct GridSelectorOptions {
  int step_px = 8;
  int max_points = 20'000;
  Result<void> check() const;
};

template <typename Field>
void describe(GridSelectorOptions& o, Field&& field) {
  field("step_px", o.step_px, OptionRange{1, 256}, "distance between keypoints, pixels");
  field("max_points", o.max_points, OptionRange{1, 1'000'000}, "most keypoints: the step grows until there are no more");
}

class GridSelector final : public KeypointSelector {
 public:
  explicit GridSelector(const GridSelectorOptions& options) : options_(options) {}
  std::string_view name() const override { return "grid"; }
  bool on_lattice() const override { return true; }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const override;

 private:
  GridSelectorOptions options_;
};

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// HarrisSelector ("harris"): C. Harris and M. Stephens, A Combined Corner and Edge Detector, 1988:
// det - sensitivity * trace^2 of the structure tensor under a smooth window (three running means, close
// to the paper's Gaussian); peaks among their neighbours (non-maximum suppression) that have at least
// quality^4 of the strongest response: it grows with the fourth power of the contrast.
// Keypoints are whole pixels, in rows from the top; strength is the share of the strongest response.
// Errors: InvalidInput (no pixels, options), NoFace (an empty region), TooFewMatches (no corner),
// OutOfMemory, Cancelled. Memory: seven planes of the picture's size in `scratch`.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/keypoint_selector.h"

namespace relievo::pipeline {

struct HarrisSelectorOptions {
  double sensitivity = 0.05;
  double quality = 0.02;
  int window_px = 3;
  int min_distance_px = 4;
  int max_points = 20'000;
  Result<void> check() const;
};

template <typename Field>
void describe(HarrisSelectorOptions& o, Field&& field) {
  field("sensitivity", o.sensitivity, OptionRange{0.01, 0.24}, "how much an edge counts against a corner");
  field("quality", o.quality, OptionRange{1e-6, 1}, "least contrast, share of the strongest corner's");
  field("window_px", o.window_px, OptionRange{3, 15}, "side of each of the three running means, pixels; odd");
  field("min_distance_px", o.min_distance_px, OptionRange{1, 64}, "corners keep this distance, pixels");
  field("max_points", o.max_points, OptionRange{1, 1'000'000}, "most keypoints: the strongest are kept");
}

class HarrisSelector final : public KeypointSelector {
 public:
  explicit HarrisSelector(const HarrisSelectorOptions& options) : options_(options) {}
  std::string_view name() const override { return "harris"; }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const override;

 private:
  HarrisSelectorOptions options_;
};

}  // namespace relievo::pipeline

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
#include "pipeline/match/kinds.h"

namespace relievo::pipeline {

struct HarrisSelector {
  double sensitivity = 0.05;
  double quality = 0.02;
  int window_px = 3;
  int min_distance_px = 4;
  int max_points = 20'000;

  void describe(auto&& field) {
    field("sensitivity", sensitivity, OptionRange{0.01, 0.24}, "how much an edge counts against a corner");
    field("quality", quality, OptionRange{1e-6, 1}, "least contrast, share of the strongest corner's");
    field("window_px", window_px, OptionRange{3, 15, 2},
          "side of each of the three running means, pixels; odd");
    field("min_distance_px", min_distance_px, OptionRange{1, 64}, "corners keep this distance, pixels");
    field("max_points", max_points, OptionRange{1, 1'000'000}, "most keypoints: the strongest are kept");
  }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const;
};

}  // namespace relievo::pipeline

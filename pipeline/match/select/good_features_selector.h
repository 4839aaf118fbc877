// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// GoodFeaturesSelector ("good-features"): corners by the smaller eigenvalue of the structure tensor
// (J. Shi and C. Tomasi, Good Features to Track, CVPR 1994); the dissertation's CvGoodTrackingFeatures.
// Several thresholds at once, as there: each of `levels` is a quality (share of the strongest corner's
// eigenvalue) and the least distance between corners of that quality; their results are united, so
// that strong corners may stand close together and weak ones fill plain skin sparsely.
// `binary_thresholds`: grey levels at which the picture is also made black and white and searched for
// corners of the outlines, with the same levels.
// Keypoints are whole pixels, in rows from the top; strength is the eigenvalue, (grey levels a pixel)^2,
// divided by the strongest one's.
// Errors: InvalidInput (no pixels, options), NoFace (an empty region), TooFewMatches (no corner),
// OutOfMemory, Cancelled. Memory: eight planes of the picture's size in `scratch`.
#pragma once

#include <string>

#include "pipeline/base/options.h"
#include "pipeline/match/kinds.h"

namespace relievo::pipeline {

struct GoodFeaturesSelector {
  std::string levels = "0.02:4+0.004:7+0.0005:10";
  std::string binary_thresholds = "none";
  int window_px = 7;
  int max_points = 20'000;
  Result<void> check() const;

  void describe(auto&& field) {
    field("levels", levels, OptionRange{0, 0},
          "QUALITY:DISTANCE_PX joined by '+': corners this good keep this distance; united");
    field("binary_thresholds", binary_thresholds, OptionRange{0, 0},
          "grey levels joined by '+' at which black and white outlines are searched too, or none");
    field("window_px", window_px, OptionRange{3, 31, 2},
          "side of the window a corner is judged in, pixels; odd");
    field("max_points", max_points, OptionRange{1, 1'000'000}, "most keypoints: the strongest are kept");
  }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const;
};

}  // namespace relievo::pipeline

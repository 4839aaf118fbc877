// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// HaarSelector ("haar"): blobs by Haar-like box filters on the integral image, the Fast-Hessian of
// H. Bay, A. Ess, T. Tuytelaars, L. Van Gool, Speeded-Up Robust Features (SURF), CVIU 110, 2008:
// det = Dxx Dyy - (0.9 Dxy)^2 of box filters 9, 15, 21, 27 pixels wide (first octave; twice the growth
// and half the sampling in each further one), peaks among their 26 neighbours in place and size,
// placed by a quadratic (Brown and Lowe 2002), then rounded to whole pixels. A peak needs quality^2 of
// the strongest response: it grows with the square of the contrast.
// Keypoints are in rows from the top; strength is the share of the strongest response.
// Errors: InvalidInput (no pixels, options), NoFace (an empty region), TooFewMatches (no blob),
// OutOfMemory, Cancelled. Memory: ten planes of the picture's size in `scratch`.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/kinds.h"

namespace relievo::pipeline {

struct HaarSelector {
  int octaves = 2;
  double quality = 0.005;
  int min_distance_px = 3;
  int max_points = 20'000;

  void describe(auto&& field) {
    field("octaves", octaves, OptionRange{1, 4},
          "ranges of blob sizes: filters of 9 to 27, 51, 99, 195 pixels");
    field("quality", quality, OptionRange{1e-6, 1}, "least contrast, share of the strongest blob's");
    field("min_distance_px", min_distance_px, OptionRange{1, 64}, "blobs keep this distance, pixels");
    field("max_points", max_points, OptionRange{1, 1'000'000}, "most keypoints: the strongest are kept");
  }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const;
};

}  // namespace relievo::pipeline

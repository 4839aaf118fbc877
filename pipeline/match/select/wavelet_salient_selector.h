// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// WaveletSalientSelector ("wavelet-salient"): E. Loupias, N. Sebe, S. Bres, J.-M. Jolion, Wavelet-based
// salient points for image retrieval, ICIP 2000, with the orthonormal Haar wavelet. From every
// coefficient, of every scale and of the three orientations, the track follows the greatest (in
// magnitude) of its four children down to the finest scale, and ends at the pixel with the greatest
// gradient under that one. The pixel's saliency is the sum of the magnitudes along the track, the
// greatest of all tracks that end there: what varies over large and small scales alike stands out.
// Keypoints are whole pixels, in rows from the top; strength is the share of the greatest saliency.
// Errors: InvalidInput (no pixels, options), NoFace (an empty region), TooFewMatches (nothing varies),
// OutOfMemory, Cancelled. Memory: four planes of the picture's size in `scratch`.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/kinds.h"

namespace relievo::pipeline {

struct WaveletSalientSelector {
  int scales = 4;
  double quality = 0.01;
  int min_distance_px = 4;
  int max_points = 20'000;

  void describe(auto&& field) {
    field("scales", scales, OptionRange{1, 8},
          "how many dyadic scales tracks may begin at: 2 to 2^scales pixels");
    field("quality", quality, OptionRange{1e-6, 1}, "least saliency, share of the greatest");
    field("min_distance_px", min_distance_px, OptionRange{1, 64}, "points keep this distance, pixels");
    field("max_points", max_points, OptionRange{1, 1'000'000}, "most keypoints: the most salient are kept");
  }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const;
};

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// WaveletMatcher ("wavelet"): coarse-to-fine comparison of dyadic wavelet coefficients, after Bhatti and
// Nahavandi ("Stereo correspondence estimation using multiwavelets scale-space representation", 2008; Bhatti,
// "Wavelets and multiwavelets" in Advances in Theory and Applications of Stereo Vision, 2011), with one
// scalar wavelet, the translation-invariant gradient wavelet, in this form:
//
// 1. At scale 2^j a place is described by the coefficients (W^x, W^y) of (2 r + 1)^2 samples 2^(j-1) apart,
//    compared by the normalised correlation rho_j = sum W_L . W_R / root(sum |W_L|^2 sum |W_R|^2).
// 2. At the coarsest scale 2^J every 2^(J-2)-th disparity of the volume is tried; the `candidates` best local
//    maxima go on. At every finer scale each looks two steps of 2^(j-2) (at least one pixel) to both sides.
// 3. The candidate whose correlations over all scales have the greatest sum wins (Bhatti's confidence).
// 4. A parabola between pixels, through the correlation of the two finest scales stacked.
//
// Blind to offset and gain. cost is one minus the stacked correlation; sigma_px as in window_matchers.h with
// the samples of one scale as count. Between pixels: bilinear coefficients in both views. Errors: as Matcher.
#pragma once

#include <vector>

#include "pipeline/base/kinds.h"
#include "pipeline/base/options.h"
#include "pipeline/base/stage.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

// The translation-invariant dyadic wavelet transform of a picture (Mallat and Zhong 1992), by the algorithm
// "a trous" (Holschneider et al. 1989): at scale 2^j, j = 1, 2, ..., with holes h = 2^(j-1), S_0 the picture,
//
//   S_j   = S_(j-1) smoothed along rows and columns by [1 4 6 4 1] / 16 (cubic B-spline) spread h apart
//   W_j^x = (S_(j-1)(x + h, y) - S_(j-1)(x - h, y)) / 2,  W_j^y likewise down
//
// Every scale has every pixel (nothing is decimated: a shifted picture has shifted coefficients), both
// filters are symmetric about the pixel, and W is blind to an offset. Border pixels are repeated. Grey
// levels. scales[j - 1] has (W_j^x, W_j^y) at every pixel. On context.scratch.
std::pmr::vector<Plane<Vec2f>> transform_dyadic(const std::pmr::vector<float>& grey, int width, int height,
                                                int scales, StageContext& context);

struct WaveletMatcher {
  static constexpr int kMostScales = 6, kMostRadius = 10, kMostCandidates = 8;
  int scales = 4;
  int radius = 4;            // samples to each side
  int candidates = 4;        // that are followed from the coarsest scale
  float min_score = 0.3F;    // mean correlation over the scales
  float sigma_limit_px = 1;  // a place less certain than this has no match

  void describe(auto&& field) {
    field("scales", scales, OptionRange{2, kMostScales},
          "dyadic scales: the coarsest is 2 to this power, pixels");
    field("radius", radius, OptionRange{1, kMostRadius},
          "samples to each side of a place, half a scale apart");
    field("candidates", candidates, OptionRange{1, kMostCandidates},
          "disparities followed from the coarsest scale to the finest");
    field("min_score", min_score, OptionRange{0, 1},
          "mean correlation over the scales below which there is no match");
    field("sigma_limit_px", sigma_limit_px, OptionRange{0.01, 10},
          "a place less certain than this has no match");
  }
  Result<MatchSet> match(const RectifiedPair& pair, const Keypoints& keypoints, StageContext& context) const;
};

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The matchers by windows: `ssd` and `zmncc`. They share the search over the volume, the fit between pixels
// and the sigma.
//
// sigma_px: the fit's standard deviation under independent noise in both views, from the score itself:
// with n pixels, S the score at the fitted minimum and S'' its second difference,
//   sigma^2 = 2 S / (n S'') + bias^2
// (S / n estimates twice the noise variance, S'' twice the summed squared gradients; of 1 - rho the same
// holds in units of the windows' own variation). Whatever else keeps the windows apart, slant, highlights,
// a wrong match next to a right one, raises S and sigma with it. `bias` is the method's own: a parabola
// through whole pixels draws towards them, and a window flattens what it lies on (taken for a face: 40 mm of
// radius; a nose is bent more, a forehead less). A wrong peak elsewhere is not in sigma: the constraints are
// for that. Three channels are counted as one sample a pixel, because demosaicking joins their noise.
#pragma once

#include "pipeline/base/kinds.h"
#include "pipeline/base/options.h"

namespace relievo::pipeline {

// SsdMatcher ("ssd"): the sum of squared differences over a square window, least over every disparity of
// the volume, then a parabola through the minimum and its neighbours (Anandan 1989; Bardsley 2004, ch. 8).
//
// Grey values are compared as they are: both cameras must be exposed alike, gain or offset between the
// views is taken for unlikeness (`zmncc` is blind to both). Grey levels (0 .. 255), pixels.
// cost is S over the variation of both windows: one minus correlation where the exposure is equal, 1 where
// they are unrelated. For sigma_px and lattices see above. Errors: as Matcher.
struct SsdMatcher {
  int window_px = 25;         // odd
  int channels = 1;           // 1: grey, 3: the three colours together
  float max_difference = 20;  // grey levels, rms over the window: less alike is no match
  float sigma_limit_px = 1;   // a place less certain than this has no match

  void describe(auto&& field) {
    field("window_px", window_px, OptionRange{3, 63, 2}, "side of the window, pixels, odd");
    field("channels", channels, OptionRange{1, 3, 2}, "1: grey values, 3: the three colours together");
    field("max_difference", max_difference, OptionRange{0.01, 255},
          "rms difference of the windows above which there is no match, grey levels");
    field("sigma_limit_px", sigma_limit_px, OptionRange{0.01, 10},
          "a place less certain than this has no match");
  }
  Result<MatchSet> match(const RectifiedPair& pair, const Keypoints& keypoints, StageContext& context) const;
};

// ZmnccMatcher ("zmncc"): zero-mean normalised cross-correlation of a square window, greatest over every
// disparity of the volume, then a fit between pixels (Faugeras et al. 1993; Bardsley 2004, ch. 8).
//
// Blind to gain and offset between the views within the window; with three channels each colour has an
// offset of its own, and all three share the gain. Pixels.
// cost is one minus the correlation. For sigma_px and lattices see above. Errors: as Matcher.
struct ZmnccMatcher {
  int window_px = 25;        // odd
  int channels = 1;          // 1: grey, 3: the three colours together
  float min_score = 0.4F;    // correlation, -1 .. 1
  int equiangular = 0;       // 1: two lines of equal slope instead of a parabola
  float sigma_limit_px = 1;  // a place less certain than this has no match

  void describe(auto&& field) {
    field("window_px", window_px, OptionRange{3, 63, 2}, "side of the window, pixels, odd");
    field("channels", channels, OptionRange{1, 3, 2}, "1: grey values, 3: the three colours together");
    field("min_score", min_score, OptionRange{0, 1}, "correlation below which there is no match");
    field("equiangular", equiangular, OptionRange{0, 1},
          "fit between pixels: 0 a parabola, 1 two lines of equal slope");
    field("sigma_limit_px", sigma_limit_px, OptionRange{0.01, 10},
          "a place less certain than this has no match");
  }
  Result<MatchSet> match(const RectifiedPair& pair, const Keypoints& keypoints, StageContext& context) const;
};

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What `ssd` and `zmncc` share: the search over the volume, the fit between pixels, the sigma.
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

#include "pipeline/match/kinds.h"
#include "pipeline/match/window/patch_scores.h"

namespace relievo::pipeline {

struct WindowRule {
  WindowScore score = WindowScore::ZeroMeanCorrelation;
  int window_px = 15;
  int channels = 1;
  bool equiangular = false;  // the fit between pixels: two lines of equal slope, not a parabola
  double most_unlike = 1;    // S a pixel and channel (squared differences), or S
  float sigma_limit_px = 1;
};

// Keypoints whose window leaves the picture, whose best candidate is the volume's end, or that the rule
// does not believe, are left out.
Result<MatchSet> match_windows(const RectifiedPair& pair, const Keypoints& keypoints, const WindowRule& rule,
                               StageContext& context);

// `bias` above, pixels: of a window this wide on a face before this rig.
double method_bias_px(const RectifiedPair& pair, int window_px);

}  // namespace relievo::pipeline

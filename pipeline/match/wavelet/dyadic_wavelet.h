// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The translation-invariant dyadic wavelet transform of a picture (Mallat and Zhong 1992), by the algorithm
// "a trous" (Holschneider et al. 1989): at scale 2^j, j = 1, 2, ..., with holes h = 2^(j-1) and S_0 the
// picture,
//
//   S_j   = S_(j-1) smoothed along rows and columns by [1 4 6 4 1] / 16 (cubic B-spline) spread h apart
//   W_j^x = (S_(j-1)(x + h, y) - S_(j-1)(x - h, y)) / 2,  W_j^y likewise down
//
// Every scale has every pixel (nothing is decimated: a shifted picture has shifted coefficients), both
// filters are symmetric about the pixel, and W is blind to an offset. Border pixels are repeated. Grey
// levels.
#pragma once

#include <vector>

#include "pipeline/base/stage.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

// scales[j - 1] has (W_j^x, W_j^y) at every pixel. On context.scratch.
std::pmr::vector<Plane<Vec2f>> transform_dyadic(const std::pmr::vector<float>& grey, int width, int height,
                                                int scales, StageContext& context);

}  // namespace relievo::pipeline

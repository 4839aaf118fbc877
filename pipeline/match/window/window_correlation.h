// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Zero-mean correlation of one window of the left view with one of the right, both anywhere between
// pixels (bilinear): how alike a match is, for matchers whose own score is none, and for constraints.
#pragma once

#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// -1 .. 1; 0 where a window is plain, leaves its picture or touches pixels that are not valid.
double window_correlation(const RectifiedPair& pair, Vec2f left_px, Vec2f right_px, int radius);

// One minus the correlation at a match, 0 .. 1.
float window_cost(const RectifiedPair& pair, Vec2f left_px, float disparity_px, int radius);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Zero-mean correlation of one window of the left view with one of the right, both anywhere between
// pixels (bilinear): how alike a match is, for matchers whose own score is none, and for constraints.
#pragma once

#include <optional>

#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// One place of the left view looked for on its row of the right one, for a few places, where the matchers'
// tables would cost more than they save. Candidates are whole disparities, both ends included, a parabola
// goes through the best; sigma_px as in window_matching.h, cost one minus the correlation. None where no
// window correlates, or the best lies at an end: what is looked for may be beyond. Pixels. Thread: any.
std::optional<Match> match_on_row(const RectifiedPair& pair, Vec2f left_px, double least_px, double most_px,
                                  int radius);

// -1 .. 1; 0 where a window is plain, leaves its picture or touches pixels that are not valid.
double window_correlation(const RectifiedPair& pair, Vec2f left_px, Vec2f right_px, int radius);

// One minus the correlation at a match, 0 .. 1.
float window_cost(const RectifiedPair& pair, Vec2f left_px, float disparity_px, int radius);

}  // namespace relievo::pipeline

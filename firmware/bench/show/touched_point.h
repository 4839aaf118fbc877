// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a finger on the rectified pair means: the match that is nearest to it, or, by hand, a point left and
// its partner right on the same row, snapped to the best likeness nearby (zero-mean normalised correlation, a
// parabola through its top) with the standard deviation that its noise allows (Cramér-Rao, as for the
// matchers). From either the point in space: the left camera's frame, millimetres, sigma along the line of
// sight. Thread: main, while no job runs. Errors: none: without a partner `matched` stays false.
#pragma once

#include "firmware/bench/show/bench_figures.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"
#include "ui/bench/bench_result.h"

namespace relievo::firmware {

// x and y are shares of the picture.
ui::BenchPoint nearest_match(const pipeline::RectifiedPair& pair, const pipeline::MatchSet& matches,
                             const BenchFigures& figures, float x, float y);
// The left point alone; the right one is waited for.
ui::BenchPoint hand_point(const pipeline::RectifiedPair& pair, float x, float y);
void match_by_hand(const pipeline::RectifiedPair& pair, float right_x, ui::BenchPoint& point);

}  // namespace relievo::firmware

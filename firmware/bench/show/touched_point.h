// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a finger on the rectified pair means: the match that is nearest to it, with the point in space it
// stands for: the left camera's frame, millimetres, sigma along the line of sight. Thread: main, while no job
// runs. Errors: none: without a partner `matched` stays false.
#pragma once

#include <algorithm>

#include "firmware/bench/show/bench_figures.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"
#include "ui/bench/bench_result.h"

namespace relievo::firmware {

inline constexpr float kFingerShare = 0.02F;  // of the picture's width: what a finger may miss a place by

inline float pixel_at(float share, int pixels) {
  return std::clamp(share * static_cast<float>(pixels), 0.0F, static_cast<float>(pixels - 1));
}
// x and y are shares of the picture.
ui::BenchPoint nearest_match(const pipeline::RectifiedPair& pair, const pipeline::MatchSet& matches,
                             const BenchFigures& figures, float x, float y);
// A place without a match.
ui::BenchPoint point_at(const pipeline::RectifiedPair& pair, float x, float y);
// The point is this match's.
void set_match(const pipeline::RectifiedPair& pair, const pipeline::Match& match, ui::BenchPoint& point);

}  // namespace relievo::firmware

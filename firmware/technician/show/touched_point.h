// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a finger on the rectified pair means: the match that is nearest to it, with the point in space it
// stands for: the left camera's frame, millimetres, sigma along the line of sight. Thread: main, while no job
// runs. Errors: none: without a partner `matched` stays false.
#pragma once

#include <algorithm>

#include "firmware/technician/show/technician_figures.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"
#include "ui/technician/technician_result.h"

namespace relievo::firmware {

inline constexpr float kFingerShare = 0.02F;  // of the picture's width: what a finger may miss a place by

inline float pixel_at(float share, int pixels) {
  return std::clamp(share * static_cast<float>(pixels), 0.0F, static_cast<float>(pixels - 1));
}
// x and y are shares of the picture.
ui::TechnicianPoint nearest_match(const pipeline::RectifiedPair& pair, const pipeline::MatchSet& matches,
                                  const TechnicianFigures& figures, float x, float y);
// A place without a match.
ui::TechnicianPoint point_at(const pipeline::RectifiedPair& pair, float x, float y);
// The point is this match's.
void set_match(const pipeline::RectifiedPair& pair, const pipeline::Match& match, ui::TechnicianPoint& point);

}  // namespace relievo::firmware

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Poses in which a person can hold a board so that both cameras of a rig see it whole: nine places in
// the picture, as far out as may be, at three distances, facing the camera and tilted eight ways.
// Inside calibrate/ only. Thread: any.
#pragma once

#include <array>
#include <vector>

#include "pipeline/calibrate/fit/bundle.h"

namespace relievo::pipeline {

struct CandidatePose {
  std::size_t number = 0;  // always the same for the same pose of the list
  bundle::Pose left_from_board;
  std::array<BoardCorners, 2> corners;  // as the two cameras would see them
};

// `quarter_turns`: how the person holds the board, clockwise from rows that run to the right.
std::vector<CandidatePose> candidate_poses(const bundle::Problem& rig, double distance_mm, int quarter_turns);

}  // namespace relievo::pipeline

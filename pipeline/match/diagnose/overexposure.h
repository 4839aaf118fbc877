// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How much of the face is white in either picture. Such skin has no texture left: it comes back as a hole, or
// not at all. Memory: none. Thread: any. Errors: none.
#pragma once

#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

inline constexpr float kWhiteGrey = 250;  // grey values, 0 .. 255, from which on a pixel is white

// Shares of the face, 0 .. 1.
struct Overexposure {
  double left = 0;
  double right = 0;
};

// Of the face that was found (RectifiedPair::face_centre_px), and in the right view where the matches say it
// is; 0 where none was looked for.
Overexposure measure_overexposure(const RectifiedPair& pair, const MatchSet& matches);

// Of a face that nothing is known of: in the middle of the volume, in which the windows' middles lie.
Overexposure guess_overexposure(const RectifiedPair& pair);

}  // namespace relievo::pipeline

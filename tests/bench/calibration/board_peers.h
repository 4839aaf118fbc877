// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpenCV's own finders of printed boards, to measure beside ours. Corners as pipeline::BoardCorners;
// empty where nothing was found. Thread: any.
#pragma once

#include "pipeline/calibrate/board/board_finder.h"

namespace relievo::bench {

// Sector-based (Duda and Frese 2018), with all that makes it sure and accurate.
pipeline::BoardCorners sector_based_board(const ImageView& picture, const pipeline::BoardPattern& pattern);
// Adaptive thresholds, then cornerSubPix.
pipeline::BoardCorners classic_board(const ImageView& picture, const pipeline::BoardPattern& pattern);
// aruco's markers, then interpolateCornersCharuco.
pipeline::BoardCorners aruco_board(const ImageView& picture, const pipeline::BoardPattern& pattern);

}  // namespace relievo::bench

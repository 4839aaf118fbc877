// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an OpenCV user does with the same pictures: the sector-based finder, calibrateCamera for each
// camera, stereoCalibrate.
#pragma once

#include <optional>
#include <vector>

#include "hal/base/image_view.h"
#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/model/calibration.h"

namespace relievo::bench {

pipeline::BoardCorners peer_corners(const ImageView& picture,
                                    const pipeline::BoardPattern& pattern);  // empty: none

struct PeerViews {
  pipeline::BoardPattern pattern;
  int width_px = 0, height_px = 0;
  std::vector<pipeline::BoardCorners> left, right;  // pairs; empty where nothing was found
};

// refine: stereoCalibrate may move the lenses once more; else they stay as each camera gave them.
std::optional<pipeline::StereoCalibration> peer_calibration(const PeerViews& views, bool refine);

}  // namespace relievo::bench

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From corners seen to a calibrated rig: each camera alone (Zhang 2000), then both together; views in
// which the two cameras disagree are found, named and left out (README.md says by which rule).
// Errors of calibrate(): InvalidInput (sizes, counts of corners), PoorGeometry (too few boards, or
// views that determine nothing; where() says how many).
// Thread: any; the same input gives the same result.
#pragma once

#include <cstddef>
#include <vector>

#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/calibrate/quality/quality.h"
#include "pipeline/model/calibration.h"

namespace relievo::pipeline {

// Not-a-number where the corner was not seen, or was dropped as a stray.
struct CornerResidual {
  Vec2d at;   // where it was seen
  Vec2d off;  // from where the fit puts it
};

// A board under the final fit. A pair that was used stands in one place for both cameras; of a pair left out
// each camera has its own. Frames: left camera, millimetres.
struct FittedView {
  bool placed = false;               // false: took no part in the fit
  RigidTransform left_from_board;    // as the left camera has it, where both disagree
  std::vector<CornerResidual> left;  // in the pattern's order; empty where the camera's board took no part
  std::vector<CornerResidual> right;
  const std::vector<CornerResidual>& corners(std::size_t eye) const { return eye == 0 ? left : right; }
};

struct CalibratorOutput {
  StereoCalibration calibration;
  CalibrationQuality quality;     // with verdict Refuse the calibration is not to be used
  std::vector<FittedView> views;  // one a view given, in their order
};

Result<CalibratorOutput> calibrate(const CalibratorInput& input);

}  // namespace relievo::pipeline

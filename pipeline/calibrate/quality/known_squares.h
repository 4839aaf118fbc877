// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The calibration tried on boards whose size is known. One camera and the known squares say how far away
// each corner is; both cameras together must find it there. That notices a camera that turned along the
// rows, which no epipolar line does, and needs no model of what goes wrong.
// Inside calibrate/ only. Thread: any.
#pragma once

#include "pipeline/calibrate/quality/quality_measures.h"
#include "pipeline/calibrate/quality/rig_spread.h"

namespace relievo::pipeline {

// Over the used views, each measured by the rig that is fitted without it. Root mean squares.
struct KnownSquares {
  double depth_mm = 0;        // of a whole board together: its corners' noise averages out
  double point_depth_mm = 0;  // of a single corner, noise of finding it included
  double length_percent = 0;  // of lengths on the board
};

// Depth is brought to `distance_mm` as a disparity's error grows, with the distance squared.
KnownSquares measure_known_squares(const Fitted& fitted, const RigSpread& spread, double distance_mm);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cables that were exchanged while a live calibration runs. Inside calibrate/ only. Thread: any.
#pragma once

#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/model/calibration.h"

namespace relievo::pipeline {

// True where the pair fits the calibration far better with left and right exchanged than as it is; the
// two are in pair_order().
bool is_exchanged(const StereoCalibration& calibration, const BoardPattern& pattern, const BoardCorners& left,
                  const BoardCorners& right);

}  // namespace relievo::pipeline

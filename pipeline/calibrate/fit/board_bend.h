// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Is the board flat? The same bend in every view leaves the same pattern in the residuals of all of
// them, which no camera and no pose can: bending along, across and twisting are estimated by one
// Newton step from the fitted rig, everything else adapting. Inside calibrate/ only. Thread: any.
#pragma once

#include "pipeline/calibrate/fit/bundle.h"

namespace relievo::pipeline {

struct BoardBend {
  double sag_mm = 0;      // greatest height above the board's mean plane, less the least
  double sigma_mm = 0;    // of the sag, one standard deviation
  double deviations = 0;  // how far from flat, in standard deviations (chi-square of 3, as a normal deviate)
};

// `solved`: a problem that solve() has just solved.
BoardBend measure_bend(const bundle::Problem& solved);

}  // namespace relievo::pipeline

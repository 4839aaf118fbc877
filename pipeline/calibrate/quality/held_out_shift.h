// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a calibration promises of the next picture: how far everything in it will lie off its epipolar
// lines together. Single corners miss their lines by their own noise, too, which says nothing about
// the rig; a linear field through a whole board's corners (offset, tilt across, tilt down) does, and it
// is what drift.h measures on a face.
// Inside calibrate/ only. Thread: any.
#pragma once

#include "pipeline/calibrate/quality/quality_measures.h"
#include "pipeline/calibrate/quality/rig_spread.h"

namespace relievo::pipeline {

// Root mean square over the corners of all used views, each judged by the rig that is fitted without it.
double held_out_shift(const Fitted& fitted, const RigSpread& spread);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A linear field through many local measurements of a shift, by iteratively reweighted least squares
// with Tukey's biweight. Its uncertainty is what the scatter of the measurements says, not what their
// weights promise, and neighbours that err together are told by summing over blocks first (sandwich
// covariance: Huber 1967; by clusters: Liang and Zeger 1986).
// Pixels of full size. Thread: any.
#pragma once

#include <span>

#include "hal/base/arena.h"
#include "pipeline/model/match_set.h"

namespace relievo::pipeline {

struct LocalShift {
  double x_px = 0;
  double y_px = 0;
  double shift_px = 0;
  double information = 0;  // larger is surer; only ratios matter, and beyond the median hardly more counts
  int block = 0;           // 0 .. kShiftBlocks - 1: measurements of one block may err together
};

inline constexpr int kShiftBlocksAcross = 6;
inline constexpr int kShiftBlocks = kShiftBlocksAcross * kShiftBlocksAcross;

// With `slopes` the field may tilt, otherwise it is one offset. Without measured() where there are too
// few, or in too few blocks.
EpipolarShift fit_shift_field(std::span<const LocalShift> locals, bool slopes, Arena& scratch);

// The field that moves by `first` and then by `second`, as uncertain as the second.
EpipolarShift sum_of(const EpipolarShift& first, const EpipolarShift& second);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What moved across the rows between the two exposures: cameras without a common trigger see a mouth
// that opens, a jaw that sinks or an eyelid that closes at two instants, and corresponding points no
// longer share a row there. A smooth field is laid through what the patches of the face say beyond the
// linear shift (row_aligner.h): a Gaussian prior of the amplitude that the data themselves show,
// a sixth of the face's width in reach, and patches that contradict their surroundings lose their say.
// Where the patches scatter no more than each is unsure, nothing moved and the field is zero.
//
// What moved along the rows cannot be seen: it looks like depth. But motion knows no rows, so what is seen
// across them says how large it may be. Full-size rectified pixels of the right view. Memory: the one given,
// and scratch. Thread: worker.
#pragma once

#include <span>

#include "hal/base/arena.h"
#include "pipeline/base/stage.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/model/match_set.h"

namespace relievo::pipeline {

// A linear field through many local measurements of a shift, by iteratively reweighted least squares
// with Tukey's biweight. Its uncertainty is what the scatter of the measurements says, not what their
// weights promise, and neighbours that err together are told by summing over blocks first (sandwich
// covariance: Huber 1967; by clusters: Liang and Zeger 1986). Thread: any.
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

inline constexpr int kMotionStepPx = 16;

struct RowMotion {
  // Nothing moves.
  RowMotion(std::pmr::memory_resource* memory, int width_px, int height_px);

  // Beyond the linear shift; bilinear, constant outside the lattice.
  double at(double x_px, double y_px) const;

  Plane<float> shift_px;  // node (i, j) stands on pixel kMotionStepPx * (i, j)
  bool seen = false;      // false: shift_px is 0 everywhere
  double rms_px = 0;      // over the patches
};

// A linear shift and what moved beside it.
struct RowShift {
  const EpipolarShift& linear;
  const RowMotion* motion = nullptr;
  double at(double x_px, double y_px) const {
    return linear.at(x_px, y_px) + (motion != nullptr ? motion->at(x_px, y_px) : 0);
  }
};

// `face_width_px` 0: unknown, half the picture. `motion`, which the patches were warped by, is replaced.
void fit_row_motion(std::span<const LocalShift> locals, const EpipolarShift& linear, double face_width_px,
                    StageContext& context, RowMotion& motion);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RowAligner: keeps the rows of the right view's pictures in step with the left view's, and the account
// of what that took: the linear shift of the whole face (a nudged camera; epipolar_alignment.h) and what
// moved beside it between the two exposures (row_motion.h).
// Every resampling starts from the pictures as they were: none is blurred twice.
// Memory: scratch; it must outlive this. Thread: worker.
#pragma once

#include "pipeline/match/epipolar/epipolar_alignment.h"

namespace relievo::pipeline {

struct RowAlignerLimits {
  double beyond_px = 0.03;  // a linear shift of less is left alone, rms over the face
  bool follow_motion = true;
};

class RowAligner {
 public:
  // Borrows all; resamples pyramids.right.
  RowAligner(const RectifiedPair& pair, Pyramids& pyramids, const RowAlignerLimits& limits,
             StageContext& context);

  // Measures on a surface good to about a pixel of half the size and resamples every level of the right
  // view. Returns the largest shift it made, full-size pixels.
  double align(const SurfaceField& field);
  // On a surface at the accuracy of half the size: what moved and has not been seen yet.
  void align_motion(const SurfaceField& field);

  // All of the linear shift, with what a finished surface still shows of it.
  EpipolarShift measure_linear(const SurfaceField& field) const;
  const RowMotion& motion() const { return motion_; }

 private:
  void apply(const EpipolarShift* linear, const RowMotion& motion);
  RowMotion measure_motion(const SurfaceField& field, const EpipolarShift& linear) const;
  double largest(const RowShift& shift) const;

  const RectifiedPair& pair_;
  Pyramids& pyramids_;
  StageContext& context_;
  RowAlignerLimits limits_;
  EpipolarShift measured_;  // the last one, where nothing was applied
  EpipolarShift applied_;
  RowMotion motion_;
};

}  // namespace relievo::pipeline

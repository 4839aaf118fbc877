// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RowAligner: keeps the rows of the right view's pictures in step with the left view's, and the account of
// what that took: the linear shift of the whole face (a nudged camera) and what moved beside it between the
// two exposures (row_motion.h). Every resampling starts from the pictures as they were: none is blurred
// twice. Memory: scratch; it must outlive this. Thread: worker.
#pragma once

#include "pipeline/base/stage.h"
#include "pipeline/match/coarse/coarse_surface.h"
#include "pipeline/match/epipolar/row_motion.h"
#include "pipeline/match/image/surface_field.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// How far corresponding points are from sharing a row after all, measured on the face's own texture,
// and the right view resampled so that they do.
//
// A camera that was nudged, a mount that warmed up or a pair that was not exposed at the same instant
// leaves a vertical disagreement that is, over one face, nearly linear in the picture. Patches of the surface
// each say what it is there; those that contradict the field through all (highlights, edges) lose their say.
//
// What the same error does along the rows cannot be seen: it changes the depth of the face, not its likeness.
// Results do not depend on the number of threads.

// Search finds shifts of many pixels: from an eighth of the size down, on a surface good to about a
// pixel of half the size. Refine measures what is left of one, at half the size on a finished surface.
enum class EpipolarSearch : std::uint8_t { Search, Refine };

// Without measured() where the face has too little texture to tell.
EpipolarShift measure_epipolar_shift(const RectifiedPair& pair, const Pyramids& pyramids,
                                     const SurfaceField& field, EpipolarSearch search, StageContext& context);

// What moved beside the linear shift that the pictures still have, on such a surface.
RowMotion measure_row_motion(const RectifiedPair& pair, const Pyramids& pyramids, const SurfaceField& field,
                             const EpipolarShift& linear, StageContext& context);

// to(x, y) = from(x, y + shift), full size, by cubic convolution; what would need rows outside is copied.
void shift_rows(const RowShift& shift, std::span<const float> from, Plane<float>& to, StageContext& context);

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

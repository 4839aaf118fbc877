// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RowAligner: keeps the rows of the right view's pictures in step with the left view's, and the account of
// what that took: the linear shift of the whole face (a nudged camera) and what moved beside it between the
// two exposures. Every resampling starts from the pictures as they were: none is blurred twice. Memory:
// scratch; it must outlive this. Thread: worker.
#pragma once

#include <span>

#include "hal/base/arena.h"
#include "pipeline/base/stage.h"
#include "pipeline/match/coarse/semi_global.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

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

// What moved across the rows between the two exposures: cameras without a common trigger see a mouth
// that opens, a jaw that sinks or an eyelid that closes at two instants, and corresponding points no
// longer share a row there. A smooth field is laid through what the patches of the face say beyond the
// linear shift: a Gaussian prior of the amplitude that the data themselves show, a sixth of the face's width
// in reach, and patches that contradict their surroundings lose their say. Where the patches scatter no more
// than each is unsure, nothing moved and the field is zero.
//
// What moved along the rows cannot be seen: it looks like depth. But motion knows no rows, so what is seen
// across them says how large it may be. Full-size rectified pixels of the right view. Memory: the one given,
// and scratch. Thread: worker.
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

// to(x, y) = from(x, y + shift), full size, by cubic convolution; what would need rows outside is copied.
void shift_rows(const RowShift& shift, std::span<const float> from, Plane<float>& to, StageContext& context);

class RowAligner {
 public:
  // Borrows all; resamples pyramids.right. A linear shift of less than `beyond_px`, rms over the face, is
  // left alone.
  RowAligner(const RectifiedPair& pair, Pyramids& pyramids, double beyond_px, bool follow_motion,
             StageContext& context)
      : pair_(pair),
        pyramids_(pyramids),
        context_(context),
        beyond_px_(beyond_px),
        follow_motion_(follow_motion) {}

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
  // What moved beside the linear shift that the pictures still have.
  RowMotion measure_motion(const SurfaceField& field, const EpipolarShift& linear) const;
  double largest(const RowShift& shift) const;

  const RectifiedPair& pair_;
  Pyramids& pyramids_;
  StageContext& context_;
  double beyond_px_;
  bool follow_motion_;
  EpipolarShift measured_;  // the last one, where nothing was applied
  EpipolarShift applied_;
  RowMotion motion_{&context_.scratch, pair_.width_px, pair_.height_px};
};

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What each patch of the face says about the shift across the rows there (Lucas and Kanade 1981), at
// one size of the pictures. Within a patch its slip along the rows, gain and offset of brightness are
// eliminated. The gradient is the left view's alone: its noise and the residual's have nothing to do
// with each other, so the estimate is not drawn towards whole or half rows.
// Memory: scratch. Results do not depend on the number of threads. Thread: worker.
#pragma once

#include <span>

#include "pipeline/base/stage.h"
#include "pipeline/match/coarse/coarse_surface.h"
#include "pipeline/match/epipolar/row_motion.h"
#include "pipeline/match/image/surface_field.h"

namespace relievo::pipeline {

// The middle of the face, where hair and neck are not; everywhere where no face was looked for.
struct FaceEllipse {
  explicit FaceEllipse(const RectifiedPair& pair);
  bool holds(double x_px, double y_px) const;  // of the left view

 private:
  double x_ = 0, y_ = 0, half_width_ = 0, half_height_ = 0;
};

class LocalShifts {
 public:
  // All are borrowed and must outlive this.
  LocalShifts(const Pyramids& pyramids, int level, const SurfaceField& field, const FaceEllipse& face,
              StageContext& context);

  // Valid until the next call.
  std::span<const LocalShift> measure(const RowShift& from);

 private:
  struct Patch;
  void gather(const RowShift& from);
  void add_node(const RowShift& from, int x, int y, double disparity_px, Patch& patch) const;

  // Order of the sums of a patch: lower triangle over slope_x, detail, 1, slope_y, residual.
  struct Patch {
    double sums[15] = {};
    double x = 0, y = 0, right2 = 0;
    int samples = 0;
  };

  const PyramidLevel& left_;
  const PyramidLevel& right_;
  const SurfaceField& field_;
  const FaceEllipse& face_;
  StageContext& context_;
  int level_;
  int stride_;       // every so many nodes of the field are a pixel of this level
  double gain_ = 1;  // of the right view over the left
  Plane<float> left_detail_;
  Plane<float> right_detail_;
  Plane<Patch> patches_;
  std::pmr::vector<LocalShift> locals_;
};

}  // namespace relievo::pipeline

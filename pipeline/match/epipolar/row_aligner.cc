// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/epipolar/row_aligner.h"

#include <algorithm>
#include <cmath>

#include "pipeline/match/epipolar/local_shifts.h"

namespace relievo::pipeline {

RowAligner::RowAligner(const RectifiedPair& pair, Pyramids& pyramids, const RowAlignerLimits& limits,
                       StageContext& context)
    : pair_(pair),
      pyramids_(pyramids),
      context_(context),
      limits_(limits),
      motion_(&context.scratch, pair.width_px, pair.height_px) {}

double RowAligner::align(const SurfaceField& field) {
  Arena::Mark mark(context_.scratch);
  measured_ = measure_epipolar_shift(pair_, pyramids_, field, EpipolarSearch::Search, context_);
  const RowMotion motion = measure_motion(field, measured_);
  const bool realign = measured_.residual_px > limits_.beyond_px;
  if (!realign && !motion.seen) return 0;
  apply(realign ? &measured_ : nullptr, motion);
  return largest({realign ? measured_ : EpipolarShift{}, &motion});
}

void RowAligner::align_motion(const SurfaceField& field) {
  Arena::Mark mark(context_.scratch);
  const RowMotion motion = measure_motion(field, EpipolarShift{});
  if (motion.seen) apply(nullptr, motion);
}

RowMotion RowAligner::measure_motion(const SurfaceField& field, const EpipolarShift& linear) const {
  if (!limits_.follow_motion) return {&context_.scratch, pair_.width_px, pair_.height_px};
  return measure_row_motion(pair_, pyramids_, field, linear, context_);
}

void RowAligner::apply(const EpipolarShift* linear, const RowMotion& motion) {
  if (linear != nullptr) applied_ = applied_.measured() ? sum_of(applied_, *linear) : *linear;
  if (motion.seen) {
    for (std::size_t k = 0; k < motion.shift_px.values.size(); ++k)
      motion_.shift_px.values[k] += motion.shift_px.values[k];
    motion_.seen = true;
    motion_.rms_px = std::hypot(motion_.rms_px, motion.rms_px);
  }
  shift_rows({applied_, &motion_}, pair_.right.grey, pyramids_.right.front().grey, context_);
  halve_levels(pyramids_.right, context_.pool);
}

double RowAligner::largest(const RowShift& shift) const {
  const FaceEllipse face(pair_);
  double most = 0;
  for (int y = 0; y < pair_.height_px; y += kMotionStepPx)
    for (int x = 0; x < pair_.width_px; x += kMotionStepPx)
      if (face.holds(x, y)) most = std::max(most, std::abs(shift.at(x, y)));
  return most;
}

EpipolarShift RowAligner::measure_linear(const SurfaceField& field) const {
  const EpipolarShift rest =
      measure_epipolar_shift(pair_, pyramids_, field, EpipolarSearch::Refine, context_);
  if (!rest.measured()) return applied_.measured() ? applied_ : measured_;
  return applied_.measured() ? sum_of(applied_, rest) : rest;
}

}  // namespace relievo::pipeline

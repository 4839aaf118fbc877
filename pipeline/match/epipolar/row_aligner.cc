// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/epipolar/row_aligner.h"

#include <algorithm>
#include <cmath>

#include "pipeline/match/epipolar/column_sample.h"
#include "pipeline/match/epipolar/local_shifts.h"

namespace relievo::pipeline {
namespace {

constexpr int kAlignedBands = 16;
constexpr int kFirstLevel = 3;
constexpr int kLastLevel = 1;     // full size would add noise, hardly detail
constexpr int kSearchRounds = 3;  // at each level
constexpr int kRefineRounds = 2;
constexpr int kMotionRounds = 10;  // a chin may move by many pixels, a round by one of half the size
constexpr double kMotionSettledPx = 0.02;

}  // namespace

EpipolarShift measure_epipolar_shift(const RectifiedPair& pair, const Pyramids& pyramids,
                                     const SurfaceField& field, EpipolarSearch search,
                                     StageContext& context) {
  const bool whole = search == EpipolarSearch::Search;
  const FaceEllipse face(pair);
  EpipolarShift shift;
  for (int level = whole ? kFirstLevel : kLastLevel; level >= kLastLevel; --level) {
    Arena::Mark mark(context.scratch);
    LocalShifts locals(pyramids, level, field, face, context);
    for (int round = 0; round < (whole ? kSearchRounds : kRefineRounds); ++round) {
      // Small pictures have too few patches for slopes.
      const EpipolarShift better =
          fit_shift_field(locals.measure({shift}), level == kLastLevel, context.scratch);
      if (!better.measured()) break;
      shift = better;
    }
  }
  return shift;
}

RowMotion measure_row_motion(const RectifiedPair& pair, const Pyramids& pyramids, const SurfaceField& field,
                             const EpipolarShift& linear, StageContext& context) {
  RowMotion motion(&context.scratch, pair.width_px, pair.height_px);
  Arena::Mark mark(context.scratch);
  const FaceEllipse face(pair);
  LocalShifts locals(pyramids, kLastLevel, field, face, context);
  double before = 0;
  for (int round = 0; round < kMotionRounds; ++round) {
    fit_row_motion(locals.measure({linear, &motion}), linear, pair.face_width_px, context, motion);
    if (!motion.seen || std::abs(motion.rms_px - before) < kMotionSettledPx) break;
    before = motion.rms_px;
  }
  return motion;
}

void shift_rows(const RowShift& shift, std::span<const float> from, Plane<float>& to, StageContext& context) {
  context.pool.for_each_band(to.height, kAlignedBands, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < to.width; ++x) {
        const double at = y + shift.at(x, y);
        const int k = static_cast<int>(std::floor(at));
        const bool inside = k >= kColumnReach && k + kColumnReach < to.height;
        const float* above = from.data() + static_cast<std::ptrdiff_t>(inside ? k : y) * to.width + x;
        to.row(y)[x] = inside ? ColumnWeights(static_cast<float>(at - k)).sample(above, to.width) : *above;
      }
  });
}

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

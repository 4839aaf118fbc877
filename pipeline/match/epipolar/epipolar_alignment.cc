// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/epipolar/epipolar_alignment.h"

#include <cmath>

#include "pipeline/match/epipolar/column_sample.h"
#include "pipeline/match/epipolar/local_shifts.h"

namespace relievo::pipeline {
namespace {

constexpr int kBands = 16;
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
  context.pool.for_each_band(to.height, kBands, [&](int begin, int end, int) {
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

}  // namespace relievo::pipeline

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
constexpr int kLastLevel = 1;  // full size would add noise, hardly detail
constexpr int kSearchRounds = 3;  // at each level
constexpr int kRefineRounds = 2;

}  // namespace

EpipolarShift measure_epipolar_shift(const RectifiedPair& pair, const Pyramids& pyramids, const SurfaceField& field,
                                     EpipolarSearch search, StageContext& context) {
  const bool whole = search == EpipolarSearch::Search;
  const FaceEllipse face(pair);
  EpipolarShift shift;
  for (int level = whole ? kFirstLevel : kLastLevel; level >= kLastLevel; --level) {
    Arena::Mark mark(context.scratch);
    LocalShifts locals(pyramids, level, field, face, context);
    for (int round = 0; round < (whole ? kSearchRounds : kRefineRounds); ++round) {
      // Small pictures have too few patches for slopes.
      const EpipolarShift better = fit_shift_field(locals.measure(shift), level == kLastLevel, context.scratch);
      if (!better.measured()) break;
      shift = better;
    }
  }
  return shift;
}

void shift_rows(const EpipolarShift& shift, int level, Plane<float>& right, StageContext& context) {
  Arena::Mark mark(context.scratch);
  Plane<float> copy(&context.scratch, right.width, right.height);
  copy.values = right.values;
  const double scale = 1 << level;
  context.pool.for_each_band(right.height, kBands, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < right.width; ++x) {
        const double at = y + shift.at(x * scale, y * scale) / scale;
        const int k = static_cast<int>(std::floor(at));
        if (k < kColumnReach || k + kColumnReach >= right.height) continue;
        right.row(y)[x] = ColumnWeights(static_cast<float>(at - k)).sample(copy.row(k) + x, right.width);
      }
  });
}

}  // namespace relievo::pipeline

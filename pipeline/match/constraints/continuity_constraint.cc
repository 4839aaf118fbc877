// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/constraints/continuity_constraint.h"

#include <cmath>

#include "pipeline/match/image/plane.h"

namespace relievo::pipeline {

void ContinuityConstraint::judge(const RectifiedPair& pair, std::span<Match> matches, int lattice_step_px,
                                 std::uint16_t bit, StageContext& context) const {
  if (lattice_step_px <= 0) return;
  Arena::Mark mark(context.scratch);
  constexpr float kNothing = -1.0e9F;
  const int step = lattice_step_px;
  Plane<float> disparity(&context.scratch, pair.width_px / step + 3, pair.height_px / step + 3, kNothing);
  const auto cell = [&](const Match& match) {
    return disparity.row(static_cast<int>(match.left_px.y) / step + 1) +
           static_cast<int>(match.left_px.x) / step + 1;
  };
  for (const Match& match : matches)
    if (match.rejected_by == 0) *cell(match) = match.disparity_px;
  const float limit = max_step * static_cast<float>(step);
  for (Match& match : matches) {
    if (match.rejected_by != 0) continue;
    const float* here = cell(match);
    int support = 0;
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        if ((i != 0 || j != 0) && std::abs(here[j * disparity.width + i] - match.disparity_px) <= limit)
          ++support;
    if (support < least_support) match.rejected_by = bit;
  }
}

}  // namespace relievo::pipeline

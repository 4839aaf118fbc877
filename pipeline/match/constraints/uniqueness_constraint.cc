// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/constraints/uniqueness_constraint.h"

#include <algorithm>
#include <cmath>

#include "pipeline/match/image/plane.h"

namespace relievo::pipeline {

void UniquenessConstraint::judge(const RectifiedPair& pair, std::span<Match> matches, int lattice_step_px,
                                 std::uint16_t bit, StageContext& context) const {
  Arena::Mark mark(context.scratch);
  // One cell a lattice column of the right view: the largest disparity that landed there.
  const int cell = std::max(1, lattice_step_px);
  constexpr float kNothing = -1.0e9F;
  Plane<float> nearest(&context.scratch, pair.width_px / cell + 1, pair.height_px / cell + 1, kNothing);
  const auto place = [&](const Match& match) -> float* {
    const float x = (match.left_px.x - match.disparity_px) / static_cast<float>(cell);
    const int column = static_cast<int>(std::lround(x));
    const int row = static_cast<int>(std::lround(match.left_px.y / static_cast<float>(cell)));
    if (x < 0 || column >= nearest.width || row < 0 || row >= nearest.height) return nullptr;
    return nearest.row(row) + column;
  };
  for (const Match& match : matches)
    if (match.rejected_by == 0)
      if (float* at = place(match)) *at = std::max(*at, match.disparity_px);
  for (Match& match : matches) {
    if (match.rejected_by != 0) continue;
    const float* at = place(match);
    if (at == nullptr || *at - match.disparity_px > margin_px) match.rejected_by = bit;
  }
}

}  // namespace relievo::pipeline

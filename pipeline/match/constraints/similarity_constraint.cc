// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/constraints/similarity_constraint.h"

namespace relievo::pipeline {

void SimilarityConstraint::judge(const RectifiedPair&, std::span<Match> matches, int, std::uint16_t bit,
                                 StageContext&) const {
  for (Match& match : matches)
    if (match.rejected_by == 0 && !(match.cost <= max_cost)) match.rejected_by = bit;
}

}  // namespace relievo::pipeline

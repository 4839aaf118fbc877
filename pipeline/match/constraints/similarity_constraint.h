// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SimilarityConstraint ("similarity"): the two views must look alike around a match: its cost (one
// minus zero-mean correlation) stays under a limit.
// Its limit is loose by default, for the sake of plain skin. Behind a matcher with a threshold of its own it
// says something only below that: behind zmncc below 1 - min_score, 0.4 in the suite of the dissertation.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/kinds.h"

namespace relievo::pipeline {

struct SimilarityConstraint {
  float max_cost =
      0.95F;  // plain skin under noise correlates little and is still right: only the unrelated go

  void describe(auto&& field) {
    field("max_cost", max_cost, OptionRange{0, 2}, "one minus correlation above which a match is rejected");
  }
  void judge(const RectifiedPair& pair, std::span<Match> matches, int lattice_step_px, std::uint16_t bit,
             StageContext& context) const;
};

}  // namespace relievo::pipeline

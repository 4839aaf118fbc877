// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// OrderingConstraint ("ordering"): along a row, points keep their order from view to view (Yuille and Poggio
// 1984). Of every row the largest set of matches that is in order stays (a longest increasing subsequence,
// Fredman 1975), the others are rejected. Thin things before a far background break the order without being
// wrong; a face has none. Scattered matches are judged with those of their row, rounded to whole pixels.
// `slack` lets the right places fall back by that share of the left ones' distance: noise on steep surfaces.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/kinds.h"

namespace relievo::pipeline {

struct OrderingConstraint {
  float slack = 0.1F;  // 0: strict order; a disparity gradient up to 1 + slack along the row is in order

  void describe(auto&& field) {
    field("slack", slack, OptionRange{0, 1},
          "how far right places may fall back, as a share of the left ones' distance");
  }
  void judge(const RectifiedPair& pair, std::span<Match> matches, int lattice_step_px, std::uint16_t bit,
             StageContext& context) const;
};

}  // namespace relievo::pipeline

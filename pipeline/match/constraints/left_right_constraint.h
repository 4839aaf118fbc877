// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LeftRightConstraint ("left-right"): a match must be found again from the other side (Fua 1993). It works
// for every matcher: the window of the right view at the match is searched for along the left row, by
// zero-mean correlation, at whole pixels within search_px of where the match says, with a parabola between
// them. Where the best place is further from the keypoint than limit_px, or at the end of the search, the
// match is rejected. Matches whose window leaves a picture cannot be asked back and stay.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/kinds.h"

namespace relievo::pipeline {

struct LeftRightConstraint {
  int window_px = 15;  // odd
  int search_px = 8;   // to each side
  float limit_px = 1;

  void describe(auto&& field) {
    field("window_px", window_px, OptionRange{3, 63, 2},
          "side of the window that is searched for, pixels, odd");
    field("search_px", search_px, OptionRange{2, 128}, "how far it is searched for to each side, pixels");
    field("limit_px", limit_px, OptionRange{0.05, 64}, "how far from the keypoint it may be found, pixels");
  }
  void judge(const RectifiedPair& pair, std::span<Match> matches, int lattice_step_px, std::uint16_t bit,
             StageContext& context) const;
};

}  // namespace relievo::pipeline

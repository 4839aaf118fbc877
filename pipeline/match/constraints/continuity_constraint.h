// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ContinuityConstraint ("continuity"): disparity varies smoothly nearly everywhere (Marr and Poggio
// 1976). On a lattice, a match most of whose neighbours differ by more than a limit is rejected;
// scattered matches are not judged.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/kinds.h"

namespace relievo::pipeline {

struct ContinuityConstraint {
  float max_step = 2.0F;  // disparity difference per pixel of distance: beyond 63 degrees of slant
  int least_support = 3;  // of the eight neighbours

  void describe(auto&& field) {
    field("max_step", max_step, OptionRange{0.01, 100},
          "disparity difference to a neighbour, pixels per pixel of distance");
    field("least_support", least_support, OptionRange{1, 8}, "how many of the eight neighbours must agree");
  }
  void judge(const RectifiedPair& pair, std::span<Match> matches, int lattice_step_px, std::uint16_t bit,
             StageContext& context) const;
};

}  // namespace relievo::pipeline

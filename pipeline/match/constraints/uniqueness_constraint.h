// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// UniquenessConstraint ("uniqueness"): a place in the right view shows one surface only (Marr and
// Poggio 1976). Where several matches of a row land on the same right pixel, the nearest surface
// hides the others: what lies behind it by more than a margin is rejected.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/kinds.h"

namespace relievo::pipeline {

struct UniquenessConstraint {
  float margin_px = 1.5F;  // a slanted surface may land twice on one pixel

  void describe(auto&& field) {
    field("margin_px", margin_px, OptionRange{0, 64},
          "how far behind another surface a match counts as hidden, pixels");
  }
  void judge(const RectifiedPair& pair, std::span<Match> matches, int lattice_step_px, std::uint16_t bit,
             StageContext& context) const;
};

}  // namespace relievo::pipeline

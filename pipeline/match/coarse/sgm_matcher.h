// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SgmMatcher ("sgm"): semi-global matching down a ladder of sizes (semi_global.h), by default from an eighth
// of the size to half. Blind to gain and offset. Pixels of full size unless named otherwise.
//
// Memory: 6 bytes a candidate and pixel of the finest size (166 MB at full 1920 x 1200, 12 candidates). cost
// is one minus the correlation of 9 x 9 pixels at the match; what does not correlate is no match. sigma_px:
// the scatter of the field around its own plane over 5 x 5 pixels of the finest size, and a sixth of such a
// pixel for the fit (the scatter of neighbours understates an error they share). Errors: as Matcher.
#pragma once

#include "pipeline/base/kinds.h"
#include "pipeline/base/options.h"
#include "pipeline/match/coarse/semi_global.h"

namespace relievo::pipeline {

struct SgmMatcher {
  SemiGlobalCosts costs;
  int finest = 1;            // the pictures are halved so often at the end: 0 is full size
  int coarsest = 3;          // and at first: every disparity is tried there
  int band = 12;             // candidates around the prediction
  float cross_check_px = 1;  // in pixels of each size
  Result<void> check() const;

  void describe(auto&& field) {
    field("finest", finest, OptionRange{0, 2},
          "how often the pictures are halved at the end: 0 full size, 1 half, 2 a quarter");
    field("coarsest", coarsest, OptionRange{0, 4},
          "how often the pictures are halved at first, where every disparity is tried");
    field("band", band, OptionRange{4, 64}, "disparities tried around what the coarser size found");
    field("step_penalty", costs.step_penalty, OptionRange{0, 24},
          "census bits for one disparity between neighbours");
    field("jump_penalty", costs.jump_penalty, OptionRange{24, 1000},
          "census bits for a jump between neighbours");
    field("cross_check_px", cross_check_px, OptionRange{0.25, 16},
          "how far the two views may disagree, pixels of each size");
  }
  Result<MatchSet> match(const RectifiedPair& pair, const Keypoints& keypoints, StageContext& context) const;
};

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// HistogramTransfer ("histogram-match"): the right view's grey values are changed so that their
// cumulative histogram becomes the left view's (histogram specification; Gonzalez and Woods, section
// 3.3); the dissertation's HistMatch. The left view stays as it is. Histograms are taken where both
// views are valid and, where a face region is marked, in it: a pixel counts with the one it would
// meet at the middle of the depth that is searched, so that what only one view sees has
// no say. Blind to any monotone difference of exposure, gamma included.
// Errors: InvalidInput (a view without pixels), OutOfMemory, Cancelled.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/kinds.h"

namespace relievo::pipeline {

struct HistogramTransfer {
  double strength = 1;

  void describe(auto&& field) {
    field("strength", strength, OptionRange{0, 1},
          "1: the right view takes the left one's histogram, 0: it stays, between: a mixture");
  }
  Result<void> process(RectifiedPair& pair, StageContext& context) const;
};

}  // namespace relievo::pipeline

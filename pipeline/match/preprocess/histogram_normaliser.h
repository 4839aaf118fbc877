// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// HistogramNormaliser ("histogram-normalise"): each view's grey values are brought to the full range
// 0..255 by the cumulative histogram of its own valid pixels; the dissertation's HistNorm.
// equalise = 1 (the default): grey becomes 255 times the share of darker pixels, classical histogram
// equalisation (Hummel 1977; Gonzalez and Woods, section 3.3): blind to any monotone change of exposure,
// gamma included, as far as both views show the same things. equalise = 0: a linear stretch that sends
// `tail` of the pixels to either end: keeps the proportions, undoes gain and offset. Between: a mixture.
// Errors: InvalidInput (a view without pixels), OutOfMemory, Cancelled.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/kinds.h"

namespace relievo::pipeline {

struct HistogramNormaliser {
  double equalise = 1;
  double tail = 0.005;

  void describe(auto&& field) {
    field("equalise", equalise, OptionRange{0, 1},
          "1: equalised by the cumulative histogram, 0: stretched linearly, between: a mixture");
    field("tail", tail, OptionRange{0, 0.2},
          "share of the pixels that the stretch sends to black, and to white");
  }
  Result<void> process(RectifiedPair& pair, StageContext& context) const;
};

}  // namespace relievo::pipeline

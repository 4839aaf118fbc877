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
#include "pipeline/match/preprocessor.h"

namespace relievo::pipeline {

struct HistogramTransferOptions {
  double strength = 1;
  Result<void> check() const;
};

template <typename Field>
void describe(HistogramTransferOptions& o, Field&& field) {
  field("strength", o.strength, OptionRange{0, 1},
        "1: the right view takes the left one's histogram, 0: it stays, between: a mixture");
}

class HistogramTransfer final : public Preprocessor {
 public:
  explicit HistogramTransfer(const HistogramTransferOptions& options) : options_(options) {}
  std::string_view name() const override { return "histogram-match"; }
  Result<void> process(RectifiedPair& pair, StageContext& context) const override;

 private:
  HistogramTransferOptions options_;
};

}  // namespace relievo::pipeline

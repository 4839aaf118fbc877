// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FileMatcher ("file-matches"): matches made by hand or elsewhere, in a text file (match_text.h).
// The file says where: keypoints are not asked, and the result is scattered whatever they are.
// cost is one minus the correlation of 9 x 9 pixels at the match; sigma_px the file's, else the option's.
// Errors: the text's; NotFound (none is named, or it was not read); TooFewMatches (none in it); as Matcher.
#pragma once

#include "pipeline/base/kinds.h"
#include "pipeline/base/options.h"
#include "pipeline/match/file/match_text.h"

namespace relievo::pipeline {

struct FileMatcher {
  TextFile file;                  // none: matching fails and says so
  float sigma_px = kHandSigmaPx;  // where the file has none

  void describe(auto&& field) {
    field("path", file, OptionRange{}, "text file, a match a line: x y disparity [sigma], rectified pixels");
    field("sigma_px", sigma_px, OptionRange{0.001, 100},
          "standard deviation of matches whose line has none, pixels");
  }
  Result<MatchSet> match(const RectifiedPair& pair, const Keypoints& keypoints, StageContext& context) const;
};

}  // namespace relievo::pipeline

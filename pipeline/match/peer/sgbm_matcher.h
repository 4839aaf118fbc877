// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SgbmMatcher ("opencv-sgbm"): OpenCV's semi-global block matching behind our interface, to compare with
// (Hirschmueller 2008 with Birchfield and Tomasi's cost; cv::StereoSGBM). P1 and P2 as OpenCV's documentation
// recommends (8 and 32 times the window's area), its left-right check, uniqueness and speckle filter.
//
// The peer works on 8-bit greys (values outside 0 .. 255 are cut) of the rows and columns the keypoints need.
// Its memory is the heap, not an arena, and it must not run out inside OpenCV, which would end the
// process: `hh` is refused where its volume would take more than 2 GiB.
// cost and sigma_px are ours (as in sgm): one minus the correlation of 9 x 9 pixels; scatter about the local
// plane and a sixth of a pixel for its fit. It cannot be stopped while OpenCV works. Errors: as Matcher.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/matcher.h"

namespace relievo::pipeline {

struct SgbmMatcherOptions {
  int window_px = 5;     // odd
  int mode = 1;          // 1: MODE_SGBM_3WAY, 2: MODE_HH
  int uniqueness = 10;   // per cent by which the best candidate must win
  int max_lr_px = 1;     // left-right check
  int speckle_px = 100;  // smaller patches of one disparity go; 0 keeps them
  Result<void> check() const;
};

template <typename Field>
void describe(SgbmMatcherOptions& o, Field&& field) {
  field("window_px", o.window_px, OptionRange{1, 31}, "side of the window, pixels, odd");
  field("mode", o.mode, OptionRange{1, 2}, "1: three paths (MODE_SGBM_3WAY), 2: eight paths (MODE_HH)");
  field("uniqueness", o.uniqueness, OptionRange{0, 100}, "per cent by which the best candidate must win");
  field("max_lr_px", o.max_lr_px, OptionRange{0, 64}, "how far the two views may disagree, pixels");
  field("speckle_px", o.speckle_px, OptionRange{0, 100000},
        "patches of one disparity smaller than this go, pixels");
}

class SgbmMatcher final : public Matcher {
 public:
  explicit SgbmMatcher(const SgbmMatcherOptions& options) : options_(options) {}
  std::string_view name() const override { return "opencv-sgbm"; }
  Result<MatchSet> match(const RectifiedPair& pair, const Keypoints& keypoints,
                         StageContext& context) const override;

 private:
  SgbmMatcherOptions options_;
};

}  // namespace relievo::pipeline

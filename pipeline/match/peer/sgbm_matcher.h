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

#include "pipeline/base/kinds.h"
#include "pipeline/base/options.h"

namespace relievo::pipeline {

enum class SgbmMode { ThreeWay, HH };  // three paths (MODE_SGBM_3WAY), eight (MODE_HH)
inline constexpr const char* kSgbmModes[] = {"3way", "hh"};

struct SgbmMatcher {
  int window_px = 5;  // odd
  SgbmMode mode = SgbmMode::ThreeWay;
  int uniqueness = 10;   // per cent by which the best candidate must win
  int max_lr_px = 1;     // left-right check
  int speckle_px = 100;  // smaller patches of one disparity go; 0 keeps them

  void describe(auto&& field) {
    field("window_px", window_px, OptionRange{1, 31, 2}, "side of the window, pixels, odd");
    field("mode", mode, OptionRange{.names = kSgbmModes},
          "3way: three paths (MODE_SGBM_3WAY), hh: eight paths (MODE_HH)");
    field("uniqueness", uniqueness, OptionRange{0, 100}, "per cent by which the best candidate must win");
    field("max_lr_px", max_lr_px, OptionRange{0, 64}, "how far the two views may disagree, pixels");
    field("speckle_px", speckle_px, OptionRange{0, 100000},
          "patches of one disparity smaller than this go, pixels");
  }
  Result<MatchSet> match(const RectifiedPair& pair, const Keypoints& keypoints, StageContext& context) const;
};

}  // namespace relievo::pipeline

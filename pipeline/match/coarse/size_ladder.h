// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Semi-global matching from small pictures to large ones (tSGM, Rothermel et al. 2012): every disparity of
// the volume at the coarsest size, then at each finer one a band of candidates around what the size before
// found; cross-checked between the views and freed of single outliers at every size. The cost does not grow
// with the range, and what is smaller than a few pixels of the coarsest size is not found. Memory: scratch; 6
// bytes a candidate and pixel of one size at a time. Thread: worker.
#pragma once

#include "pipeline/base/stage.h"
#include "pipeline/match/coarse/semi_global.h"
#include "pipeline/match/image/image_pyramid.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

struct SizeLadder {
  int coarsest = 3;  // level of the pyramid: the pictures are 2^level smaller
  int finest = 2;
  int band = 12;                // candidates around the prediction
  float cross_check_px = 1.5F;  // how far the views may disagree, pixels of each size
};

// What is looked for, full-size pixels.
struct DisparityInterval {
  double least_px = 0, most_px = 0;
};
DisparityInterval whole_range(const RectifiedPair& pair);  // from far_mm to near_mm

// Fills `left` (the finest level's size) with disparities in its pixels, kNoDisparity where there is none.
// Progress goes from 0 to `progress_share`. Errors: Cancelled.
Result<void> match_down(const DisparityInterval& range, const Pyramids& pyramids, const SizeLadder& ladder,
                        const SemiGlobalCosts& costs, StageContext& context, float progress_share,
                        Plane<float>& left);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TwoWay: both views of one size matched against each other by semi-global matching, and what leads from
// one size to the next: a band of candidates around the coarser field (after Rothermel et al. 2012).
// Memory: scratch; 2 * width * height * candidates * 3 bytes inside match_both.
#pragma once

#include "pipeline/base/stage.h"
#include "pipeline/match/coarse/semi_global.h"
#include "pipeline/match/image/image_pyramid.h"

namespace relievo::pipeline {

struct TwoWay {
  TwoWay(std::pmr::memory_resource* memory, int w, int h)
      : left(memory, w, h, kNoDisparity),
        right(memory, w, h, kNoDisparity),
        first_left(memory, w, h),
        first_right(memory, w, h) {}
  Plane<float> left, right;                     // disparities of the left and of the right view's pixels
  Plane<std::int16_t> first_left, first_right;  // the band's first candidate at every pixel
};

// Errors: Cancelled.
Result<void> match_both(const PyramidLevel& left, const PyramidLevel& right, int candidates,
                        const SemiGlobalCosts& costs, StageContext& context, TwoWay& both);

// Bands for the finer size: every pixel takes its coarse parent's disparity; where that is unknown, the
// last one known on the row stands in. Between whole_first and whole_last, disparities of the finer size.
void predict(const Plane<float>& coarse, int band, int whole_first, int whole_last,
             Plane<std::int16_t>& first);

// A 3 x 3 median over what is known; closes single holes.
void median3(Plane<float>& field, StageContext& context);

}  // namespace relievo::pipeline

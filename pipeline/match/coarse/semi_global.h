// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Semi-global matching (Hirschmueller 2008) on the census transform, in a band of candidates
// around a disparity already known for every pixel (after Rothermel et al. 2012): memory is 3 bytes * width *
// height * candidates, whatever the range.
//
// Candidate k of pixel (x, y) is the disparity first(x, y) + k. Eight paths. Thread: one caller.
// Errors: std::bad_alloc when the arena is too small (run_stage makes it OutOfMemory).
#pragma once

#include <atomic>
#include <cstdint>
#include <memory_resource>

#include "pipeline/base/stage.h"
#include "pipeline/match/image/image_pyramid.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// The census transform (Zabih and Woodfill, Non-parametric local transforms for computing visual
// correspondence, 1994), blind to gain and offset. Thread: any, on rows of their own.

// One bit a neighbour (9 x 7 without the centre) that is darker than the centre, of rows [begin, end). The
// border, four columns and three rows wide, stays 0.
void census_rows(const Plane<float>& grey, Plane<std::uint64_t>& census, int begin, int end);

struct CensusPair {
  const Plane<std::uint64_t>& from;  // the view the disparity field belongs to
  const Plane<std::uint64_t>& to;
  const Plane<std::uint8_t>& from_valid;
  const Plane<std::uint8_t>& to_valid;
  int sign;  // +1: x_to = x - d (left to right); -1: x_to = x + d
};

// Of every pixel of row y its candidates' costs: the bits in which both views differ where it would be found
// at disparity first[x] + k, kUnknownCost where one of them knows nothing. Room: width * candidates.
inline constexpr std::uint8_t kUnknownCost = 40;  // worse than any chance match (31)
void census_costs(const CensusPair& pair, const std::int16_t* first, int y, int candidates,
                  std::uint8_t* cost);

struct SemiGlobalCosts {
  int step_penalty = 3;   // P1, in census bits: neighbours one disparity apart
  int jump_penalty = 24;  // P2: anything further
};

// Fills `disparity` (same size; kNoDisparity where nothing can be known) with sub-pixel minima.
// Returns early, once `cancelled` is set: what is filled then is of no use.
void semi_global(const CensusPair& pair, const Plane<std::int16_t>& first, int candidates,
                 const SemiGlobalCosts& costs, std::pmr::memory_resource& scratch, Plane<float>& disparity,
                 const std::atomic<bool>* cancelled = nullptr);

// Semi-global matching from small pictures to large ones (tSGM, Rothermel et al. 2012): every disparity of
// the volume at the coarsest size, then at each finer one a band of candidates around what the size before
// found; cross-checked between the views and freed of single outliers at every size. The cost does not grow
// with the range, and what is smaller than a few pixels of the coarsest size is not found. Memory: scratch; 6
// bytes a candidate and pixel of one size at a time. Thread: worker.
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

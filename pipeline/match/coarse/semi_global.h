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
#include "pipeline/match/image/plane.h"
#include "pipeline/match/image/plane_filters.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// The census transform (Zabih and Woodfill, Non-parametric local transforms for computing visual
// correspondence, 1994), blind to gain and offset. Thread: any, on rows of their own.

// One bit a neighbour (9 x 7 without the centre) that is darker than the centre, of row y. The border, four
// columns and three rows wide, stays 0.
void census_row(const Plane<float>& grey, Plane<std::uint64_t>& census, int y);

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

// The rough field from which refinement starts: semi-global matching over the whole volume on
// pictures an eighth of the size, then in a narrow band at a quarter, cross-checked between the
// views, and the one connected surface that is the face.
struct CoarseSurfaceOptions {
  int band = 12;                // candidates around the prediction at the finer level
  float cross_check_px = 1.5F;  // in pixels of the finer level
  int largest_hole = 600;       // pixels of the finer level: enclosed holes up to this size are bridged
};

inline constexpr int kCoarseLevel = 3;
inline constexpr int kFineLevel = 2;

// No face was looked for: every surface is wanted, not one.
inline bool is_scene(const RectifiedPair& pair) { return pair.region.empty(); }

// `field` is a lattice over the pixels of level 2 (step 4), or of level 1 (step 2; a scene needs it for its
// thin parts); its domain is what was found: the region's largest surface, all but specks of a scene. Errors:
// TooFewMatches, Cancelled.
Result<void> find_coarse_surface(const RectifiedPair& pair, const Pyramids& pyramids,
                                 const CoarseSurfaceOptions& options, StageContext& context,
                                 SurfaceField& field);

// Looks once more, at half the size and over the depths of the face alone, for what a smooth field passes by.
// From the side of a nose to the cheek and from the chin to the throat the disparity jumps by more than
// refinement finds back over, and at a quarter of the size the rims themselves are hardly two pixels wide.
// Where semi-global matching of half the size disagrees with the field by more than a pixel and a half over a
// whole window, the field is set anew; what it finds in one surface with the face beside the field is added
// to it. `field` is a lattice over the pixels of level 1 (step 2) that knows the face. Memory: scratch, a
// third of a whole picture's. Results do not depend on the number of threads. Thread: any. Errors: Cancelled.
Result<void> search_edges(const RectifiedPair& pair, const Pyramids& pyramids,
                          const CoarseSurfaceOptions& options, StageContext& context, SurfaceField& field);

// Bridges smoothly the holes that the surface encloses, so that refinement can look there: highlights and
// plain skin fail the cross-check and may still be found from their surroundings. What the finer pictures do
// not confirm keeps a large sigma and goes; what is hidden from the right view breaks the uniqueness rule and
// goes. `usable`: where a hole may lie, `largest`: nodes it may have; a hole at the rim of the picture, or
// beside what is not usable, is open and stays. Thread: any.
void bridge_holes(const Plane<std::uint8_t>& usable, int largest, Plane<std::uint8_t>& domain,
                  Plane<float>& disparity, std::pmr::memory_resource& scratch);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Semi-global matching (Hirschmueller 2008) on the census transform (census.h), in a band of candidates
// around a disparity already known for every pixel (after Rothermel et al. 2012): memory is 3 bytes * width *
// height * candidates, whatever the range.
//
// Candidate k of pixel (x, y) is the disparity first(x, y) + k. Eight paths. Thread: one caller.
// Errors: std::bad_alloc when the arena is too small (run_stage makes it OutOfMemory).
#pragma once

#include <atomic>
#include <cstdint>
#include <memory_resource>

#include "pipeline/match/coarse/census.h"
#include "pipeline/match/image/plane.h"

namespace relievo::pipeline {

struct SemiGlobalCosts {
  int step_penalty = 3;   // P1, in census bits: neighbours one disparity apart
  int jump_penalty = 24;  // P2: anything further
};

inline constexpr float kNoDisparity = -1.0e6F;

// Fills `disparity` (same size; kNoDisparity where nothing can be known) with sub-pixel minima.
// Returns early, once `cancelled` is set: what is filled then is of no use.
void semi_global(const CensusPair& pair, const Plane<std::int16_t>& first, int candidates,
                 const SemiGlobalCosts& costs, std::pmr::memory_resource& scratch, Plane<float>& disparity,
                 const std::atomic<bool>* cancelled = nullptr);

// Marks as kNoDisparity what the other view does not confirm within `limit_px`.
void cross_check(Plane<float>& left, const Plane<float>& right, float limit_px);

}  // namespace relievo::pipeline

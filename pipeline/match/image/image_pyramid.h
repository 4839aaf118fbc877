// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pyramid step: half the size, pixel (i, j) of the smaller picture centred on pixel (2i, 2j) of the
// larger, after a 5-tap binomial low-pass (Burt and Adelson 1983). Border pixels are repeated.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/base/thread_pool.h"
#include "pipeline/base/stage.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

struct PyramidLevel {
  PyramidLevel(std::pmr::memory_resource* memory, int width, int height)
      : grey(memory, width, height), valid(memory, width, height) {}
  Plane<float> grey;
  Plane<std::uint8_t> valid;
};

// Rows [begin, end) of the smaller picture.
void halve_rows(const float* grey, const std::uint8_t* valid, int width, int height, PyramidLevel& half,
                int begin, int end);

// Fills every level from the one before; the first must be filled.
void halve_levels(std::pmr::vector<PyramidLevel>& levels, ThreadPool& pool);

// Both views at full size, half, a quarter, ... On context.scratch.
struct Pyramids {
  std::pmr::vector<PyramidLevel> left;  // [level]; level 0 full size
  std::pmr::vector<PyramidLevel> right;
};

Pyramids build_pyramids(const RectifiedPair& pair, int count, StageContext& context);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Separable filters of a plane of numbers: sums over a square; in place Gaussian, erosion and dilation by a
// square, for which the plane's edge goes on outwards. `room` is theirs to overwrite: as high as the plane,
// wider by twice Gaussian::reach, or as wide. Thread: one caller; uses the pool's. Bit for bit the same for
// any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "pipeline/base/stage.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// to(x, y) = sum of from over |dx|, |dy| <= radius, with 0 outside; from and to may be the same plane. By
// running sums: the cost does not depend on the radius. `across` is scratch of the same size.
void box_sum(const Plane<float>& from, int radius, ThreadPool& pool, Plane<float>& across, Plane<float>& to);

class Gaussian {
 public:
  explicit Gaussian(double sigma_cells);  // cut off at three sigma, at 16 cells at most
  int reach() const { return reach_; }
  void smooth(Plane<float>& plane, ThreadPool& pool, Plane<float>& room) const;

 private:
  std::array<float, 17> weight_{};  // the middle first, which counts half: each is added from both sides
  int reach_ = 0;
};

// Every value becomes the least, or the most, of the square of 2 * reach + 1 around it.
void erode(Plane<float>& plane, int reach, ThreadPool& pool, Plane<float>& room);
void dilate(Plane<float>& plane, int reach, ThreadPool& pool, Plane<float>& room);

// Pyramid step: half the size, pixel (i, j) of the smaller picture centred on pixel (2i, 2j) of the
// larger, after a 5-tap binomial low-pass (Burt and Adelson 1983). Border pixels are repeated.
struct PyramidLevel {
  PyramidLevel(std::pmr::memory_resource* memory, int width, int height)
      : grey(memory, width, height), valid(memory, width, height) {}
  Plane<float> grey;
  Plane<std::uint8_t> valid;
};

// Row j of the smaller picture.
void halve_row(const PyramidLevel& whole, PyramidLevel& half, int j);

// Fills every level from the one before; the first must be filled.
void halve_levels(std::pmr::vector<PyramidLevel>& levels, ThreadPool& pool);

// Both views at full size, half, a quarter, ... On context.scratch.
struct Pyramids {
  std::pmr::vector<PyramidLevel> left;  // [level]; level 0 full size
  std::pmr::vector<PyramidLevel> right;
};

Pyramids build_pyramids(const RectifiedPair& pair, int count, StageContext& context);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Separable filters of a plane of numbers: sums over a square; in place Gaussian, erosion and dilation by a
// square, for which the plane's edge goes on outwards. `room` is theirs to overwrite: as high as the plane,
// wider by twice Gaussian::reach, or as wide. Thread: one caller; uses the pool's. Bit for bit the same for
// any number of threads.
#pragma once

#include <array>

#include "hal/base/thread_pool.h"
#include "pipeline/match/image/plane.h"

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

}  // namespace relievo::pipeline

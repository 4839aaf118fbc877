// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keypoint: a place in the left rectified view worth matching.
#pragma once

#include <memory_resource>
#include <vector>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct Keypoint {
  Vec2f at_px;
  float strength = 0;
};

struct Keypoints {
  explicit Keypoints(std::pmr::memory_resource* memory) : points(memory) {}
  std::pmr::vector<Keypoint> points;
  // Keypoints on a regular lattice (row by row, step_px apart) keep their neighbourhood for dense
  // matchers and grid meshers; 0 where they are scattered.
  int lattice_step_px = 0;
};

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PointCloud: measured points in the left camera's frame (before rectification), millimetres.
#pragma once

#include <memory_resource>
#include <vector>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct CloudPoint {
  Vec3f at_mm;
  Vec2f left_px;       // where the left rectified view saw it
  float sigma_mm = 0;  // one standard deviation along the line of sight
};

struct PointCloud {
  explicit PointCloud(std::pmr::memory_resource* memory) : points(memory) {}
  std::pmr::vector<CloudPoint> points;
  int lattice_step_px = 0;  // left_px lie on a lattice with this step; 0 where scattered
  Vec3d right_camera_mm;    // where the other view stands; all 0 where there is none, or it is unknown
};

}  // namespace relievo::pipeline

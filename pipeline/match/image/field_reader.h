// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads a dense disparity field at keypoints: between its pixels, with the scatter around its own plane.
#pragma once

#include "pipeline/match/image/plane.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct FieldReading {
  bool known = false;
  float disparity = 0;  // pixels of the field
  float scatter =
      0;  // rms about the least-squares plane of 5 x 5 pixels; of those within 2 pixels of the middle
};

// `at` in pixels of the field. Bilinear between four that lie on one surface (within a pixel of each
// other), else the nearest. Values of `nothing` and below are unknown.
FieldReading read_disparity(const Plane<float>& field, Vec2f at, float nothing);

}  // namespace relievo::pipeline

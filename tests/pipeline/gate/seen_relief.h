// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A face as the gate's pictures show it, and an empty relief of such pictures.
#pragma once

#include <cstddef>
#include <functional>

#include "pipeline/base/workspace.h"
#include "pipeline/gate/relief/live_relief.h"

namespace relievo::pipeline {

inline constexpr double kFocalPx = 737, kFaceDistanceMm = 540, kPixelMm = kFaceDistanceMm / kFocalPx;

// Depth at millimetres right and down of a point of the face, at the depth of the face; 0: nothing known.
using Depth = std::function<double(double right, double down)>;

struct SeenRelief : Workspace {
  Relief relief{&output};

  SeenRelief(int width_px, int height_px, const Vec2d& centre_px)
      : Workspace(1, std::size_t{8} << 20, std::size_t{32} << 20) {
    relief.width_px = width_px, relief.height_px = height_px;
    relief.focal_px = kFocalPx, relief.baseline_mm = 140, relief.centre_px = centre_px;
    const auto count = std::size_t(width_px * height_px);
    relief.depth_mm.resize(count);
    relief.surface.resize(count);
    relief.grey.resize(count);
  }
};

}  // namespace relievo::pipeline

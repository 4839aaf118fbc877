// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SurfaceField: disparities over a lattice, as the search for a surface carries them from coarse to fine.
// Pixels are those of the full size. Thread: any, one at a time.
#pragma once

#include <cstdint>

#include "pipeline/match/image/plane.h"

namespace relievo::pipeline {

// A field over the nodes of a lattice; node (i, j) stands on full-size pixel (step_px * i, step_px * j).
struct SurfaceField {
  SurfaceField(std::pmr::memory_resource* memory, int width, int height, int step)
      : step_px(step), shape{memory, width, height} {}
  int step_px;
  PlaneShape shape;
  Plane<float> disparity_px{shape};   // full-size pixels
  Plane<std::uint8_t> domain{shape};  // 1 where the surface is solved for
  Plane<float> sigma_px{shape};       // of disparity_px
  Plane<float> cost{shape};           // 1 - local zero-mean correlation
};

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Backdrop: what a photograph showed around the face, hair, ears and neck, out of focus on a head's rough
// shape. It stands behind the face where it is shown; it is no measurement, and is neither stored nor
// exported.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

// A grid of columns * rows vertices, row by row; none where nothing is known. Left camera's frame,
// millimetres.
struct Backdrop {
  explicit Backdrop(std::pmr::memory_resource* memory) : at_mm(memory), rgba(memory) {}
  int columns = 0, rows = 0;
  std::pmr::vector<Vec3f> at_mm;
  std::pmr::vector<std::array<std::uint8_t, 4>>
      rgba;  // sRGB as photographed, dimmed; opacity, not premultiplied
};

}  // namespace relievo::pipeline

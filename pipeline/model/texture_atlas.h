// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TextureAtlas: the photograph on the surface. RGB, sRGB-coded as captured; (0, 0) is the upper left
// corner of the upper left texel, (1, 1) the lower right of the lower right (glTF's convention).
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct TextureAtlas {
  explicit TextureAtlas(std::pmr::memory_resource* memory)
      : rgb(memory), uv(memory), vertex_rgb(memory) {}
  std::pmr::vector<std::uint8_t> rgb;         // 3 a texel, width_px * height_px
  int width_px = 0;
  int height_px = 0;
  std::pmr::vector<Vec2f> uv;                 // one a corner: 3 a triangle, in the mesh's order
  std::pmr::vector<std::uint8_t> vertex_rgb;  // 3 a vertex: for formats that colour vertices
};

}  // namespace relievo::pipeline

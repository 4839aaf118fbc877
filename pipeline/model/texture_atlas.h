// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TextureAtlas: the photograph on the surface. RGB, sRGB-coded as captured; (0, 0) is the upper left
// corner of the upper left texel, (1, 1) the lower right of the lower right (glTF's convention).
// `origin` says what a texel's colour is: a photograph's, or ours where no camera saw the surface.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

inline constexpr std::uint8_t kNoSurfaceTexel = 0;       // beyond the charts: their colours continued
inline constexpr std::uint8_t kFilledTexel = 1;          // surface that was completed, not photographed
inline constexpr std::uint8_t kLeftPhotographTexel = 2;  // 2 (left view alone) to 255 (right view alone)

struct TextureAtlas : PixelGrid {
  explicit TextureAtlas(std::pmr::memory_resource* memory)
      : rgb(memory), origin(memory), uv(memory), vertex_rgb(memory) {}
  std::pmr::vector<std::uint8_t> rgb;         // 3 a texel, width_px * height_px
  std::pmr::vector<std::uint8_t> origin;      // 1 a texel, see above; empty where it is not known
  std::pmr::vector<Vec2f> uv;                 // one a corner: 3 a triangle, in the mesh's order
  std::pmr::vector<std::uint8_t> vertex_rgb;  // 3 a vertex: for formats that colour vertices
};

// Backdrop: what a photograph showed around the face, hair, ears and neck, out of focus on a head's rough
// shape. Shown behind the face, no measurement, neither stored nor exported. A grid of columns * rows
// vertices, row by row; none where nothing is known. Left camera's frame, millimetres.
struct Backdrop {
  explicit Backdrop(std::pmr::memory_resource* memory) : at_mm(memory), rgba(memory) {}
  int columns = 0, rows = 0;
  std::pmr::vector<Vec3f> at_mm;
  std::pmr::vector<std::array<std::uint8_t, 4>> rgba;  // sRGB, dimmed; opacity, not premultiplied
};

}  // namespace relievo::pipeline

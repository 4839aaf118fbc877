// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Chart: the face laid flat. A surface measured from one pair is 2.5-D in the left rectified view, so
// that view itself is the chart: one piece, no seams, and the left photograph needs no warping.
// On a plane triangle disparity is affine in this chart, so the right photograph needs no perspective.
//
// Texels: (0, 0) is the centre of the upper left texel. Parts of a completed surface that lie behind
// another part share its texels: the front one owns them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/model/texture_atlas.h"

namespace relievo::pipeline {

struct Chart {
  explicit Chart(std::pmr::memory_resource* memory) : texel(memory), disparity_px(memory) {}
  int width_px = 0;
  int height_px = 0;
  double texels_per_px = 1;                // of the left view
  Vec2d origin_px;                         // where texel (0, 0) lies in the left view
  std::pmr::vector<Vec2f> texel;           // one a vertex
  std::pmr::vector<float> disparity_px;    // one a vertex

  std::size_t size() const { return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px); }
  float left_x(float texel_x) const { return static_cast<float>(origin_px.x) + texel_x / static_cast<float>(texels_per_px); }
  float left_y(float texel_y) const { return static_cast<float>(origin_px.y) + texel_y / static_cast<float>(texels_per_px); }
};

inline constexpr float kNoSurface = -1e30F;  // disparity of a texel without surface

// What no texturer can work with: InvalidInput.
Result<void> check_texture_input(const FaceMesh& mesh, const RectifiedPair& pair);

// At most `max_px` wide and high; never finer than the photograph. `margin_px` texels stay free
// around the face. Throws std::bad_alloc.
Chart lay_out(const FaceMesh& mesh, const RectifiedPair& pair, int max_px, int margin_px,
              std::pmr::memory_resource* memory);

// The front surface's disparity in every texel, kNoSurface elsewhere.
std::pmr::vector<float> front_disparity(const FaceMesh& mesh, const Chart& chart, std::pmr::memory_resource* memory);

// One value a vertex, spread over the texels the triangle owns; `target` keeps its value elsewhere.
void spread(const FaceMesh& mesh, const Chart& chart, std::span<const float> front,
            std::span<const float> value, std::span<float> target);

// Corner coordinates in glTF's convention, into `atlas.uv`.
void write_uv(const FaceMesh& mesh, const Chart& chart, TextureAtlas& atlas);

// Continues the colours outwards where `front` has no surface, so that filtering at the outline and
// smaller copies of the texture mix in skin and not black. Nothing of the room gets into the atlas.
void continue_outwards(const Chart& chart, std::span<const float> front, std::span<std::uint8_t> rgb);

// Reads each vertex's colour out of the finished atlas.
void colour_vertices(const Chart& chart, TextureAtlas& atlas);

}  // namespace relievo::pipeline

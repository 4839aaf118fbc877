// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A textured model seen by a pinhole camera, drawn in software: nearest surface in front, texture between its
// texels, four samples a pixel. Triangles are far smaller than their distance, so the texture is
// interpolated affinely across them (error below a tenth of a texel).
// Throws std::bad_alloc. Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "pipeline/model/face_model.h"

namespace relievo::pipeline {

struct ViewCamera {
  RigidTransform view_from_camera;  // from the left camera's frame; x right, y down, z away from this camera
  double focal_px = 0;
  Vec2d centre_px;
  int width_px = 0;
  int height_px = 0;
  std::array<std::uint8_t, 3> background{200, 200, 200};
};

struct TexturedView {
  explicit TexturedView(std::pmr::memory_resource* memory) : rgb(memory), shows(memory) {}
  std::pmr::vector<std::uint8_t> rgb;    // 3 a pixel
  std::pmr::vector<std::uint8_t> shows;  // as in recognition_images.h, of most of the pixel
};

TexturedView draw_textured(const FaceMesh& mesh, const TextureAtlas& atlas, const ViewCamera& camera,
                           std::pmr::memory_resource* output, std::pmr::memory_resource* scratch);

}  // namespace relievo::pipeline

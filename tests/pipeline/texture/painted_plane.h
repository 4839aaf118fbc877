// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A painted surface photographed by both views, so that the right colour of every vertex is known.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory_resource>

#include "pipeline/model/face_mesh.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/model/texture_atlas.h"
#include "tests/pipeline/mesh/stage_room.h"

namespace relievo::pipeline {

inline constexpr int kPaintedWidth = 400, kPaintedHeight = 300;
inline constexpr double kFocal = 600, kBaseline = 100, kDepth = 500;

// Paint at a place of the world, 40 to 200 in each channel, smooth over some millimetres.
inline Vec3d paint(double x, double y) {
  return {120 + 60 * std::sin(x / 9), 110 + 50 * std::cos(y / 7), 130 + 40 * std::sin((x + y) / 11)};
}

// Both cameras look along z; the right one stands 100 mm to the right, its window follows the surface.
inline RectifiedPair photographed(const std::function<double(double, double)>& depth_on_ray,
                                  double right_gain = 1) {
  RectifiedPair pair(std::pmr::get_default_resource());
  pair.width_px = kPaintedWidth;
  pair.height_px = kPaintedHeight;
  pair.focal_px = kFocal;
  pair.baseline_mm = kBaseline;
  pair.left_centre_px = {kPaintedWidth / 2.0, kPaintedHeight / 2.0};
  pair.right_centre_px = {kPaintedWidth / 2.0 + kFocal * kBaseline / kDepth, kPaintedHeight / 2.0};
  pair.right_from_left.translation_mm = {-kBaseline, 0, 0};
  const auto shoot = [&](RectifiedView& view, const Vec2d& centre, double camera_x, double gain) {
    for (int y = 0; y < kPaintedHeight; ++y)
      for (int x = 0; x < kPaintedWidth; ++x) {
        const double sx = (x - centre.x) / kFocal;
        const double sy = (y - centre.y) / kFocal;
        const double z = depth_on_ray(sx, camera_x);
        const Vec3d colour = paint(camera_x + sx * z, sy * z);
        for (const double c : {colour.x, colour.y, colour.z})
          view.rgb.push_back(static_cast<std::uint8_t>(std::lround(gain * c)));
        view.valid.push_back(1);
      }
  };
  shoot(pair.left, pair.left_centre_px, 0, 1);
  shoot(pair.right, pair.right_centre_px, kBaseline, right_gain);
  return pair;
}

inline RectifiedPair photographed_plane(double right_gain = 1) {
  return photographed([](double, double) { return kDepth; }, right_gain);
}

// A lattice of vertices every 4 px of the left view, a border of 40 px left free.
inline FaceMesh plane_mesh(std::pmr::memory_resource* memory = std::pmr::get_default_resource()) {
  FaceMesh mesh(memory);
  const int columns = (kPaintedWidth - 80) / 4 + 1;
  const int rows = (kPaintedHeight - 80) / 4 + 1;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      mesh.vertices_mm.push_back({static_cast<float>((40 + 4 * c - kPaintedWidth / 2.0) / kFocal * kDepth),
                                  static_cast<float>((40 + 4 * r - kPaintedHeight / 2.0) / kFocal * kDepth),
                                  static_cast<float>(kDepth)});
      mesh.normals.push_back({0, 0, -1});
      mesh.sigma_mm.push_back(0.1F);
      mesh.measured.push_back(1);
    }
  const auto at = [&](int c, int r) { return static_cast<std::uint32_t>(r * columns + c); };
  for (int r = 0; r + 1 < rows; ++r)
    for (int c = 0; c + 1 < columns; ++c) {
      mesh.triangles.push_back({at(c, r), at(c, r + 1), at(c + 1, r + 1)});
      mesh.triangles.push_back({at(c, r), at(c + 1, r + 1), at(c + 1, r)});
    }
  return mesh;
}

// What a renderer would show at a corner.
inline Vec3d look_up(const TextureAtlas& atlas, const Vec2f& uv) {
  const double x = double(uv.x) * atlas.width_px - 0.5;
  const double y = double(uv.y) * atlas.height_px - 0.5;
  const int u = static_cast<int>(std::floor(x));
  const int v = static_cast<int>(std::floor(y));
  double sum[3] = {0, 0, 0};
  for (int dy = 0; dy < 2; ++dy)
    for (int dx = 0; dx < 2; ++dx) {
      const double w = (dx == 0 ? 1 - (x - u) : x - u) * (dy == 0 ? 1 - (y - v) : y - v);
      const auto column = static_cast<std::size_t>(std::clamp(u + dx, 0, atlas.width_px - 1));
      const auto row = static_cast<std::size_t>(std::clamp(v + dy, 0, atlas.height_px - 1));
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += w * atlas.rgb[3 * (row * static_cast<std::size_t>(atlas.width_px) + column) + c];
    }
  return {sum[0], sum[1], sum[2]};
}

}  // namespace relievo::pipeline

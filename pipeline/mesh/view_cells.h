// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ViewCells: cells over the picture plane, x/z and y/z, with about two members each, points or triangles in
// front of the camera: where the nearest is looked for. Millimetres. Thread: any, once made.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory_resource>
#include <span>

#include "pipeline/base/cells.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

class ViewCells {
 public:
  // corners(k): which of `points` are those of member `k`, of at least one. Throws std::bad_alloc when
  // `memory` is used up.
  template <typename Corners>
  ViewCells(std::span<const Vec3f> points, std::size_t members, Corners&& corners,
            std::pmr::memory_resource* memory)
      : cells_(memory) {
    if (points.empty()) return;
    float right = -kMost, bottom = -kMost;
    for (const Vec3f& p : points) {
      left_ = std::min(left_, p.x / p.z);
      right = std::max(right, p.x / p.z);
      top_ = std::min(top_, p.y / p.z);
      bottom = std::max(bottom, p.y / p.z);
      nearest_mm_ = std::min(nearest_mm_, p.z);
    }
    side_ = std::sqrt(std::max((right - left_) * (bottom - top_), 1e-9F) * kInCell / float(members));
    const int columns = int((right - left_) / side_) + 1, rows = int((bottom - top_) / side_) + 1;
    const auto cell = [this](float at, float from, int count) {
      return std::clamp(int((at - from) / side_), 0, count - 1);
    };
    cells_.fill(columns, rows, [&](auto&& add) {
      for (std::uint32_t k = 0; k < members; ++k) {
        float l = kMost, u = kMost, r = -kMost, d = -kMost;
        for (const std::uint32_t v : corners(k)) {
          l = std::min(l, points[v].x / points[v].z);
          r = std::max(r, points[v].x / points[v].z);
          u = std::min(u, points[v].y / points[v].z);
          d = std::max(d, points[v].y / points[v].z);
        }
        for (int y = cell(u, top_, rows); y <= cell(d, top_, rows); ++y)
          for (int x = cell(l, left_, columns); x <= cell(r, left_, columns); ++x) add(x, y, k);
      }
    });
  }

  float nearest_mm() const { return nearest_mm_; }  // the least depth of all points

  // look(member), ring by ring around the line of sight to a place, until what lies beyond is further away,
  // across the line of sight at that depth alone, than `squared_mm`, which look() makes less.
  template <typename Squared, typename Look>
  void search(const Vec3f& at, float depth_mm, const Squared& squared_mm, Look&& look) const {
    const int c = int(std::floor((at.x / at.z - left_) / side_));
    const int r = int(std::floor((at.y / at.z - top_) / side_));
    const int most =
        std::max({std::abs(c), std::abs(c - cells_.columns()), std::abs(r), std::abs(r - cells_.rows())}) + 1;
    const auto done = [&](int ring) {
      const float beyond = float(ring - 1) * side_ * kObliquity * depth_mm;
      return ring > most || (ring > 0 && beyond > 0 && beyond * beyond >= squared_mm);
    };
    cells_.by_rings(c, r, done, look);
  }

 private:
  static constexpr float kMost = std::numeric_limits<float>::max();
  static constexpr float kInCell = 2;
  // A step in x/z is at least so much of an angle within 60 degrees of the axis.
  static constexpr float kObliquity = 0.5F;

  float left_ = kMost, top_ = kMost, nearest_mm_ = kMost, side_ = 1;
  Cells cells_;
};

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From triangles to texels: which texels a triangle covers, in bands of rows that threads can share,
// and what each view sees in front.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/stage.h"
#include "pipeline/texture/chart/chart.h"

namespace relievo::pipeline {

struct RowRange { int begin = 0, end = 0; };  // rows begin .. end - 1

// Calls paint(x, y, a, b, c) with the weights of the corners for every texel of the triangle in `rows`.
template <typename Paint>
void for_each_texel(const Vec2f& a, const Vec2f& b, const Vec2f& c, int width_px, RowRange rows, Paint&& paint) {
  const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (!(std::abs(area) > 1e-6F)) return;
  const float to_unit = 1 / area;
  // A hair beyond the edges, so that rounding opens no crack between neighbours and takes no texel
  // from a vertex that lies on its centre.
  constexpr float kHair = 0.01F;
  constexpr float kEdge = -1e-3F;
  const int top = std::max(rows.begin, static_cast<int>(std::ceil(std::min({a.y, b.y, c.y}) - kHair)));
  const int bottom = std::min(rows.end - 1, static_cast<int>(std::floor(std::max({a.y, b.y, c.y}) + kHair)));
  const int left = std::max(0, static_cast<int>(std::ceil(std::min({a.x, b.x, c.x}) - kHair)));
  const int right = std::min(width_px - 1, static_cast<int>(std::floor(std::max({a.x, b.x, c.x}) + kHair)));
  for (int y = top; y <= bottom; ++y) {
    const float dy = static_cast<float>(y) - a.y;
    for (int x = left; x <= right; ++x) {
      const float dx = static_cast<float>(x) - a.x;
      const float wb = (dx * (c.y - a.y) - dy * (c.x - a.x)) * to_unit;
      const float wc = ((b.x - a.x) * dy - (b.y - a.y) * dx) * to_unit;
      if (wb < kEdge || wc < kEdge || wb + wc > 1 - kEdge) continue;
      paint(x, y, 1 - wb - wc, wb, wc);
    }
  }
}

// The triangles that lie whole within the chart, by the bands of rows they touch, in the mesh's order.
class RowBands {
 public:
  RowBands(const FaceMesh& mesh, const Chart& chart, int bands, std::pmr::memory_resource* memory);
  int count() const { return bands_; }
  RowRange rows(int band) const { return {height_ * band / bands_, height_ * (band + 1) / bands_}; }
  std::span<const std::uint32_t> triangles(int band) const {
    const std::size_t b = static_cast<std::size_t>(band);
    return std::span(triangles_).subspan(first_[b], first_[b + 1] - first_[b]);
  }

 private:
  int band_of(float y) const;
  int bands_, height_;
  std::pmr::vector<std::uint32_t> first_;
  std::pmr::vector<std::uint32_t> triangles_;
};

inline constexpr float kNoDisparity = -1e30F;
inline constexpr std::uint32_t kNoTriangle = ~std::uint32_t{0};

// What stands in front in one view: the largest disparity on each of its texels.
struct FrontMap {
  FrontMap(const Chart& chart, float side, std::pmr::memory_resource* memory);
  float side;            // 0 the middle view, kLeftSide, kRightSide
  float scale;           // texels a pixel
  float shift = 0;       // of its columns against the chart's
  int width_px = 0, height_px = 0;
  std::pmr::vector<float> nearest;      // kNoDisparity where nothing is
  std::pmr::vector<std::uint32_t> owner; // the triangle it belongs to; kept for the middle view alone

  float column(float texel_x, float disparity) const { return texel_x + side * disparity * scale - shift; }
  // Whether a point of the chart is hidden by something nearer by more than `tolerance_px` of disparity.
  bool sees(const Vec2f& texel, float disparity, float tolerance_px) const;
};

// Fills the maps band by band; every band writes its own rows. Stops early when the stage is stopped.
void fill_front_maps(const FaceMesh& mesh, const Chart& chart, const RowBands& bands, std::span<FrontMap> maps, StageContext& context);

}  // namespace relievo::pipeline

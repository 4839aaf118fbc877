// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which places of a raster a triangle covers. Thread: any.
#pragma once

#include <algorithm>
#include <cmath>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct RowRange {
  int begin = 0, end = 0;
};  // rows begin .. end - 1

// Calls paint(x, y, a, b, c) with the weights of the corners for every texel of the triangle in `rows`.
template <typename Paint>
void for_each_texel(const Vec2f& a, const Vec2f& b, const Vec2f& c, int width_px, RowRange rows,
                    Paint&& paint) {
  const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (!(std::abs(area) > 1e-6F)) return;
  const float to_unit = 1 / area;
  // A hair beyond the edges, so that rounding opens no crack between neighbours and takes no texel
  // from a vertex that lies on its centre.
  constexpr float kHair = 0.01F;
  constexpr float kEdge = -1e-3F;
  const int top = std::max(rows.begin, int(std::ceil(std::min({a.y, b.y, c.y}) - kHair)));
  const int bottom = std::min(rows.end - 1, int(std::floor(std::max({a.y, b.y, c.y}) + kHair)));
  const int left = std::max(0, int(std::ceil(std::min({a.x, b.x, c.x}) - kHair)));
  const int right = std::min(width_px - 1, int(std::floor(std::max({a.x, b.x, c.x}) + kHair)));
  for (int y = top; y <= bottom; ++y) {
    const float dy = float(y) - a.y;
    for (int x = left; x <= right; ++x) {
      const float dx = float(x) - a.x;
      const float wb = (dx * (c.y - a.y) - dy * (c.x - a.x)) * to_unit;
      const float wc = ((b.x - a.x) * dy - (b.y - a.y) * dx) * to_unit;
      if (wb < kEdge || wc < kEdge || wb + wc > 1 - kEdge) continue;
      paint(x, y, 1 - wb - wc, wb, wc);
    }
  }
}

}  // namespace relievo::pipeline

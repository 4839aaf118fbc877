// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FaceRuler: a scale and the distance of two touched points on a model that fills a page. Ui sets the points
// and where they are seen (ui/render/face_projection.h), the page draws them. Thread: main. Errors: none.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "pipeline/model/geometry.h"

namespace relievo::ui {

struct FaceRuler {
  bool on = false;                             // touches set points
  std::array<pipeline::Vec3f, 2> points_mm{};  // on the surface, frame of face_projection.h
  std::size_t count = 0;
  // Of the newest frame: where they are, shares of the model's picture; its size and a millimetre, pixels.
  std::array<pipeline::Vec2f, 2> seen{};
  float width_px = 0, height_px = 0, px_per_mm = 0;

  float distance_mm() const {
    const auto &a = points_mm[0], &b = points_mm[1];
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
  }
  // Is it seen in the same places?
  bool stands_as(const FaceRuler& other) const {
    const auto far = [](float a, float b) { return std::abs(a - b) > 1e-4F; };
    bool same = count == other.count && !far(width_px, other.width_px) && !far(height_px, other.height_px) &&
                !far(px_per_mm, other.px_per_mm);
    for (std::size_t i = 0; i < count; ++i)
      same = same && !far(seen[i].x, other.seen[i].x) && !far(seen[i].y, other.seen[i].y);
    return same;
  }
  // A third point begins anew.
  void set(const pipeline::Vec3f& point) {
    if (count == points_mm.size()) count = 0;
    points_mm[count++] = point;
  }
};

}  // namespace relievo::ui

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TriangleGrid: a surface of triangles that answers "what is the nearest point on you?". A uniform
// grid over the triangles' boxes; the search goes outwards ring by ring and is exact within its
// reach. Millimetres, any frame. Thread: any number at once, once built.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "hal/base/groups.h"
#include "pipeline/model/vector3.h"

namespace relievo::firmware::measure {

using pipeline::Vec3d, pipeline::Vec3f;

struct Surface {
  std::vector<Vec3f> vertices_mm;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct Nearest {
  double distance_mm = 0;
  Vec3d at_mm;
  Vec3d normal;  // of the triangle, unit length, either side
};

class TriangleGrid {
 public:
  explicit TriangleGrid(const Surface& surface);  // borrowed
  // Nothing within reach_mm.
  std::optional<Nearest> nearest(const Vec3d& point_mm, double reach_mm) const;

 private:
  struct Cell {
    int x, y, z;
  };
  struct Found {
    double best = 0;  // how far
    std::optional<std::uint32_t> which{};
    Vec3d at{};
  };
  Cell cell_of(const Vec3d& point_mm) const;
  std::size_t index_of(const Cell& cell) const;
  void look(const Cell& cell, const Vec3d& point_mm, Found& found) const;
  void look_at_ring(const Cell& centre, int ring, const Vec3d& point_mm, Found& found) const;

  const Surface& surface_;
  double cell_mm_ = 1;
  Vec3d origin_mm_;
  int nx_ = 0, ny_ = 0, nz_ = 0;
  Groups triangles_;  // of each cell
};

}  // namespace relievo::firmware::measure

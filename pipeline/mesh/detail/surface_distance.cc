// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/detail/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "pipeline/base/cells.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr float kTrianglesPerCell = 2;

float squared_to_segment(const Vec3f& p, const Vec3f& a, const Vec3f& b) {
  const Vec3f along = minus(b, a);
  const float square = dot(along, along);
  const float share = square > 0 ? std::clamp(dot(minus(p, a), along) / square, 0.0F, 1.0F) : 0;
  return squared_distance(p, plus(a, times(along, share)));
}

// Cells over x/z, y/z, each with the triangles that touch it.
class CellIndex {
 public:
  CellIndex(std::span<const Vec3f> vertices, std::span<const Triangle> triangles,
            std::pmr::memory_resource* memory)
      : vertices_(vertices), triangles_(triangles), cells_(memory) {
    float right = -std::numeric_limits<float>::max();
    float bottom = right;
    for (const Vec3f& v : vertices) {
      left_ = std::min(left_, v.x / v.z);
      right = std::max(right, v.x / v.z);
      top_ = std::min(top_, v.y / v.z);
      bottom = std::max(bottom, v.y / v.z);
      nearest_mm_ = std::min(nearest_mm_, v.z);
    }
    const float area = std::max((right - left_) * (bottom - top_), 1e-9F);
    side_ = std::sqrt(area * kTrianglesPerCell / static_cast<float>(triangles.size()));
    fill(static_cast<int>((right - left_) / side_) + 1, static_cast<int>((bottom - top_) / side_) + 1);
  }

  double squared_distance(const Vec3f& p) const {
    const int c = static_cast<int>(std::floor((p.x / p.z - left_) / side_));
    const int r = static_cast<int>(std::floor((p.y / p.z - top_) / side_));
    double best = std::numeric_limits<double>::max();
    const int most =
        std::max({std::abs(c), std::abs(c - cells_.columns()), std::abs(r), std::abs(r - cells_.rows())}) + 1;
    const auto done = [&](int ring) {
      // What lies beyond this ring is further away across the line of sight alone.
      const double beyond = static_cast<double>(ring - 1) *
                            static_cast<double>(side_ * kObliquity * std::min(nearest_mm_, p.z));
      return ring > most || (ring > 0 && beyond > 0 && best <= beyond * beyond);
    };
    cells_.by_rings(c, r, done, [&](std::uint32_t k) {
      const Triangle& t = triangles_[k];
      best =
          std::min(best, squared_distance_to_triangle(p, vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]));
    });
    return best;
  }

 private:
  // A step in x/z is at least so much of an angle within 60 degrees of the axis.
  static constexpr float kObliquity = 0.5F;

  void fill(int columns, int rows) {
    cells_.fill(columns, rows, [&](auto&& add) {
      for (std::uint32_t k = 0; k < triangles_.size(); ++k) {
        float l = std::numeric_limits<float>::max(), u = l, r = -l, d = -l;
        for (const std::uint32_t v : triangles_[k]) {
          l = std::min(l, vertices_[v].x / vertices_[v].z);
          r = std::max(r, vertices_[v].x / vertices_[v].z);
          u = std::min(u, vertices_[v].y / vertices_[v].z);
          d = std::max(d, vertices_[v].y / vertices_[v].z);
        }
        const auto cell = [this](float at, float from, int count) {
          return std::clamp(static_cast<int>((at - from) / side_), 0, count - 1);
        };
        for (int y = cell(u, top_, rows); y <= cell(d, top_, rows); ++y)
          for (int x = cell(l, left_, columns); x <= cell(r, left_, columns); ++x) add(x, y, k);
      }
    });
  }

  std::span<const Vec3f> vertices_;
  std::span<const Triangle> triangles_;
  float left_ = std::numeric_limits<float>::max(), top_ = std::numeric_limits<float>::max();
  float nearest_mm_ = std::numeric_limits<float>::max();
  float side_ = 1;
  Cells cells_;
};

}  // namespace

double squared_distance_to_triangle(const Vec3f& p, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const Vec3f n = cross(minus(b, a), minus(c, a));
  const float square = dot(n, n);
  // Above the triangle where it lies on the inner side of all three edges.
  const bool inside = square > 0 && dot(cross(minus(b, a), minus(p, a)), n) >= 0 &&
                      dot(cross(minus(c, b), minus(p, b)), n) >= 0 &&
                      dot(cross(minus(a, c), minus(p, c)), n) >= 0;
  if (inside) {
    const double height = static_cast<double>(dot(minus(p, a), n));
    return height * height / static_cast<double>(square);
  }
  return static_cast<double>(
      std::min({squared_to_segment(p, a, b), squared_to_segment(p, b, c), squared_to_segment(p, c, a)}));
}

SurfaceDistance distance_to_surface(std::span<const Vec3f> points, std::span<const Vec3f> vertices,
                                    std::span<const Triangle> triangles, std::pmr::memory_resource* memory) {
  SurfaceDistance result;
  if (points.empty() || triangles.empty()) return result;
  const CellIndex index(vertices, triangles, memory);
  double sum = 0;
  double most = 0;
  for (const Vec3f& p : points) {
    const double square = index.squared_distance(p);
    sum += square;
    most = std::max(most, square);
  }
  result.rms_mm = std::sqrt(sum / static_cast<double>(points.size()));
  result.max_mm = std::sqrt(most);
  return result;
}

}  // namespace relievo::pipeline

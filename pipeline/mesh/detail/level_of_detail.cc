// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/detail/level_of_detail.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "pipeline/base/cells.h"
#include "pipeline/mesh/detail/sliver_mender.h"
#include "pipeline/model/seam_split.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

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
    side_ = std::sqrt(area * kTrianglesPerCell / float(triangles.size()));
    fill(int((right - left_) / side_) + 1, int((bottom - top_) / side_) + 1);
  }

  double squared_distance(const Vec3f& p) const {
    const int c = int(std::floor((p.x / p.z - left_) / side_));
    const int r = int(std::floor((p.y / p.z - top_) / side_));
    double best = std::numeric_limits<double>::max();
    const int most =
        std::max({std::abs(c), std::abs(c - cells_.columns()), std::abs(r), std::abs(r - cells_.rows())}) + 1;
    const auto done = [&](int ring) {
      // What lies beyond this ring is further away across the line of sight alone.
      const double beyond = double(ring - 1) * double(side_ * kObliquity * std::min(nearest_mm_, p.z));
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
          return std::clamp(int((at - from) / side_), 0, count - 1);
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

constexpr std::uint32_t kUnused = 0xFFFFFFFFU;
constexpr int kMostTries = 8;
constexpr double kMoreEachTry = 2;

// What has several entries lies on a seam and stays, with all that it has.
std::pmr::vector<std::uint8_t> on_seam(const SeamSplit& split, std::size_t vertices,
                                       std::pmr::memory_resource* memory) {
  std::pmr::vector<std::uint8_t> shares(vertices, 0, memory), seam(memory);
  for (const auto& entry : split.entries) shares[entry.vertex] = shares[entry.vertex] == 0 ? 1 : 2;
  for (const auto& entry : split.entries) seam.push_back(shares[entry.vertex] > 1 ? 1 : 0);
  return seam;
}

// `model` with these triangles alone, and the vertices they use.
void take_over(const FaceModel& model, const SeamSplit& split, const std::pmr::vector<Triangle>& triangles,
               FaceModel& lighter, std::pmr::memory_resource* memory) {
  std::pmr::vector<std::uint32_t> place(model.mesh.vertices_mm.size(), kUnused, memory);
  for (const Triangle& t : triangles)
    for (const std::uint32_t entry : t) place[split.entries[entry].vertex] = 0;
  FaceMesh& mesh = lighter.mesh;
  const bool coloured = !model.texture.vertex_rgb.empty();
  const bool posed = !model.mesh.pose.empty();
  std::uint32_t used = 0;
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (place[v] == kUnused) continue;
    mesh.vertices_mm[used] = model.mesh.vertices_mm[v];
    mesh.normals[used] = model.mesh.normals[v];
    mesh.sigma_mm[used] = model.mesh.sigma_mm[v];
    mesh.measured[used] = model.mesh.measured[v];
    if (posed) mesh.pose[used] = model.mesh.pose[v];
    if (coloured)
      std::copy_n(&model.texture.vertex_rgb[3 * v], 3, &lighter.texture.vertex_rgb[std::size_t{3} * used]);
    place[v] = used++;
  }
  mesh.vertices_mm.resize(used);
  mesh.normals.resize(used);
  mesh.sigma_mm.resize(used);
  mesh.measured.resize(used);
  if (posed) mesh.pose.resize(used);
  if (coloured) lighter.texture.vertex_rgb.resize(std::size_t{3} * used);
  mesh.triangles.resize(triangles.size());
  lighter.texture.uv.resize(model.texture.uv.empty() ? 0 : 3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.triangles[t][k] = place[split.entries[triangles[t][k]].vertex];
      if (!lighter.texture.uv.empty()) lighter.texture.uv[3 * t + k] = split.entries[triangles[t][k]].uv;
    }
}

bool hangs_together(const FaceModel& model) {
  const FaceMesh& mesh = model.mesh;
  const std::size_t n = mesh.vertices_mm.size();
  if (mesh.normals.size() != n || mesh.sigma_mm.size() != n || mesh.measured.size() != n ||
      (!mesh.pose.empty() && mesh.pose.size() != n) || mesh.triangles.empty())
    return false;
  if (!model.texture.uv.empty() && model.texture.uv.size() != 3 * mesh.triangles.size()) return false;
  if (!model.texture.vertex_rgb.empty() && model.texture.vertex_rgb.size() != 3 * n) return false;
  return std::ranges::all_of(mesh.triangles, [n](const auto& t) { return t[0] < n && t[1] < n && t[2] < n; });
}

}  // namespace

double squared_distance_to_triangle(const Vec3f& p, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const Vec3f n = cross(minus(b, a), minus(c, a));
  const float square = dot(n, n);
  // Above the triangle where it lies on the inner side of all three edges.
  const bool inside = square > 0 && dot(cross(minus(b, a), minus(p, a)), n) >= 0 &&
                      dot(cross(minus(c, b), minus(p, b)), n) >= 0 &&
                      dot(cross(minus(a, c), minus(p, c)), n) >= 0;
  if (inside) {
    const double height = double(dot(minus(p, a), n));
    return height * height / double(square);
  }
  return double(
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
  result.rms_mm = std::sqrt(sum / double(points.size()));
  result.max_mm = std::sqrt(most);
  return result;
}

Result<void> DetailOptions::check() const {
  if (triangles < 100 || triangles > 10'000'000)
    return Error{Errc::InvalidInput, "a level of detail has 100 to 10000000 triangles"}.at("lod");
  if (!(max_error_mm > 0)) return Error{Errc::InvalidInput, "the largest error must be above 0 mm"}.at("lod");
  return {};
}

Result<LighterModel> lighten(const FaceModel& model, const DetailOptions& options,
                             std::pmr::memory_resource* memory) {
  RELIEVO_TRY(options.check());
  if (!hangs_together(model)) return Error{Errc::InvalidInput, "the model does not hang together"}.at("lod");
  LighterModel lighter(memory);
  std::size_t wanted = std::size_t(options.triangles);
  const SeamSplit split = split_at_seams(model.mesh, model.texture.uv, memory);
  const std::pmr::vector<std::uint8_t> seam = on_seam(split, model.mesh.vertices_mm.size(), memory);
  std::pmr::vector<Vec3f> at_mm(memory);
  for (const auto& entry : split.entries) at_mm.push_back(model.mesh.vertices_mm[entry.vertex]);
  for (int turn = 0; turn < kMostTries && wanted < model.mesh.triangles.size(); ++turn) {
    std::pmr::vector<Triangle> triangles(split.triangles, memory);
    collapse_edges(at_mm, triangles, wanted, seam, memory);
    lighter.model = model;  // all that stays, whatever else a model may carry
    take_over(model, split, triangles, lighter.model, memory);
    const SurfaceDistance distance = distance_to_surface(
        model.mesh.vertices_mm, lighter.model.mesh.vertices_mm, lighter.model.mesh.triangles, memory);
    lighter.rms_error_mm = distance.rms_mm;
    lighter.max_error_mm = distance.max_mm;
    if (distance.max_mm <= options.max_error_mm) return lighter;
    wanted = std::size_t(kMoreEachTry * double(wanted));
  }
  lighter.model = model;
  lighter.rms_error_mm = lighter.max_error_mm = 0;
  return lighter;
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/detail/level_of_detail.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "pipeline/mesh/detail/sliver_mender.h"
#include "pipeline/mesh/view_cells.h"
#include "pipeline/model/seam_split.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

float squared_to_segment(const Vec3f& p, const Vec3f& a, const Vec3f& b) {
  const Vec3f along = minus(b, a);
  const float square = dot(along, along);
  const float share = square > 0 ? std::clamp(dot(minus(p, a), along) / square, 0.0F, 1.0F) : 0;
  return squared_distance(p, plus(a, times(along, share)));
}

constexpr std::uint32_t kUnused = 0xFFFFFFFFU;
constexpr int kMostTries = 8;
constexpr double kMoreEachTry = 2;

// Leaves a model these triangles alone, and the vertices they use.
void keep_triangles(FaceModel& model, const SeamSplit& split, const std::pmr::vector<Triangle>& triangles,
                    std::pmr::memory_resource* memory) {
  FaceMesh& mesh = model.mesh;
  std::pmr::vector<std::uint32_t> place(mesh.vertices_mm.size(), kUnused, memory);
  for (const Triangle& t : triangles)
    for (const std::uint32_t entry : t) place[split.entries[entry].vertex] = 0;
  std::uint32_t used = 0;
  for (std::uint32_t& p : place)
    if (p != kUnused) p = used++;
  const auto pack = [&](auto& values, std::size_t each = 1) {
    if (values.empty()) return;
    for (std::size_t v = 0; v < place.size(); ++v)
      for (std::size_t k = 0; k < each && place[v] != kUnused; ++k)
        values[each * place[v] + k] = values[each * v + k];
    values.resize(each * used);
  };
  pack(mesh.vertices_mm);
  pack(mesh.normals);
  pack(mesh.sigma_mm);
  pack(mesh.measured);
  pack(mesh.pose);
  pack(model.texture.vertex_rgb, 3);
  mesh.triangles.resize(triangles.size());
  if (!model.texture.uv.empty()) model.texture.uv.resize(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& entry = split.entries[triangles[t][k]];
      mesh.triangles[t][k] = place[entry.vertex];
      if (!model.texture.uv.empty()) model.texture.uv[3 * t + k] = entry.uv;
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
  const ViewCells cells(
      vertices, triangles.size(), [&](std::size_t k) { return triangles[k]; }, memory);
  double sum = 0;
  double most = 0;
  for (const Vec3f& p : points) {
    double square = std::numeric_limits<double>::max();
    cells.search(p, std::min(cells.nearest_mm(), p.z), square, [&](std::uint32_t k) {
      const Triangle& t = triangles[k];
      square =
          std::min(square, squared_distance_to_triangle(p, vertices[t[0]], vertices[t[1]], vertices[t[2]]));
    });
    sum += square;
    most = std::max(most, square);
  }
  result.rms_mm = std::sqrt(sum / double(points.size()));
  result.max_mm = std::sqrt(most);
  return result;
}

Result<void> DetailOptions::check() const {
  if (triangles < 100 || triangles > 10'000'000)
    return invalid("a level of detail has 100 to 10000000 triangles").at("lod");
  if (!(max_error_mm > 0)) return invalid("the largest error must be above 0 mm").at("lod");
  return {};
}

Result<LighterModel> lighten(const FaceModel& model, const DetailOptions& options,
                             std::pmr::memory_resource* memory) {
  RELIEVO_TRY(options.check());
  if (!hangs_together(model)) return invalid("the model does not hang together").at("lod");
  LighterModel lighter(memory);
  std::size_t wanted = std::size_t(options.triangles);
  const SeamSplit split = split_at_seams(model.mesh, model.texture.uv, memory);
  // What has several entries lies on a seam and stays, with all that it has.
  std::pmr::vector<std::uint8_t> shares(model.mesh.vertices_mm.size(), 0, memory), seam(memory);
  for (const auto& entry : split.entries) shares[entry.vertex] = shares[entry.vertex] == 0 ? 1 : 2;
  for (const auto& entry : split.entries) seam.push_back(shares[entry.vertex] > 1 ? 1 : 0);
  std::pmr::vector<Vec3f> at_mm(memory);
  for (const auto& entry : split.entries) at_mm.push_back(model.mesh.vertices_mm[entry.vertex]);
  for (int turn = 0; turn < kMostTries && wanted < model.mesh.triangles.size(); ++turn) {
    std::pmr::vector<Triangle> triangles(split.triangles, memory);
    collapse_edges(at_mm, triangles, wanted, seam, memory);
    lighter.model = model;  // all that stays, whatever else a model may carry
    keep_triangles(lighter.model, split, triangles, memory);
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

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/meshers/base_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "hal/base/statistics.h"
#include "pipeline/mesh/detail/sliver_mender.h"
#include "pipeline/mesh/lattice/lattice_surface.h"
#include "pipeline/mesh/meshers/grid_mesher.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr float kMeasuredEdges = 1.5F;  // a vertex that many usual edges from a measured point is measured
constexpr float kAnySlope = 1e6F;
constexpr float kBeyondEdges = 0.3F;  // and so many beyond the border it may lie
constexpr float kSigmaPerMm = 0.05F;  // what a vertex further from the points loses in certainty

struct Carried {
  float sigma_mm;
  std::uint8_t measured;
};

// Of every vertex; none where one lies too far from what was measured. Half of it where it was stopped.
std::pmr::vector<std::optional<Carried>> carry_over(const FaceMesh& base, std::span<const Vec3f> vertices,
                                                    const FinishOptions& options, StageContext& context) {
  const NearestVertex nearest(base.vertices_mm, &context.scratch);
  const auto border = border_vertices(base, &context.scratch);
  const float usual = usual_edge_mm(base.vertices_mm, base.triangles, &context.scratch);
  std::pmr::vector<std::optional<Carried>> carried(vertices.size(), &context.scratch);
  for (std::size_t v = 0; v < vertices.size() && !context.stop(); ++v) {
    if (!(vertices[v].z > 0)) continue;
    const auto hit = nearest.find(vertices[v], float(options.max_gap_mm));
    if (hit.vertex == NearestVertex::kNone) continue;
    const float distance = std::sqrt(hit.squared_mm);
    if (border[hit.vertex] && distance > kBeyondEdges * usual)
      continue;  // nothing grows over the measured border
    const bool measured = base.measured[hit.vertex] && distance <= kMeasuredEdges * usual;
    carried[v] = {base.sigma_mm[hit.vertex] + kSigmaPerMm * std::max(distance - usual, 0.0F),
                  measured ? std::uint8_t{1} : std::uint8_t{0}};
  }
  return carried;
}

constexpr float kReachEdges = 1.2F;  // how many usual edges a node may lie from a measured point ...
constexpr float kDisagreeMm = 0.5F;  // ... and how far from the surface around it
constexpr float kDisagreeSigmas = 4;
constexpr int kBands = 64;

}  // namespace

NearestVertex::NearestVertex(std::span<const Vec3f> points, std::pmr::memory_resource* memory)
    : points_(points),
      cells_(
          points, points.size(), [](std::uint32_t i) { return std::array{i}; }, memory) {}

NearestVertex::Hit NearestVertex::find(const Vec3f& at, float within_mm) const {
  Hit best{kNone, within_mm * within_mm};
  if (points_.empty()) return best;
  cells_.search(at, at.z, best.squared_mm, [&](std::uint32_t i) {
    const float square = squared_distance(points_[i], at);
    if (square < best.squared_mm) best = {i, square};
  });
  return best;
}

float usual_edge_mm(std::span<const Vec3f> vertices, std::span<const Triangle> triangles,
                    std::pmr::memory_resource* memory) {
  std::pmr::vector<float> lengths(memory);
  lengths.reserve(triangles.size());
  for (const Triangle& t : triangles) lengths.push_back(distance(vertices[t[1]], vertices[t[0]]));
  return lengths.empty() ? 0 : float(median(lengths));
}

FaceMesh densify(const FaceMesh& base, float spacing_mm, std::pmr::memory_resource* memory) {
  FaceMesh dense(memory);
  const auto visit = [&](auto&& add) {
    for (const Triangle& t : base.triangles) {
      const Vec3f &a = base.vertices_mm[t[0]], &b = base.vertices_mm[t[1]], &c = base.vertices_mm[t[2]];
      const float longest =
          std::sqrt(std::max({squared_distance(a, b), squared_distance(b, c), squared_distance(c, a)}));
      const int parts = int(std::ceil(longest / spacing_mm));
      for (int i = 0; parts > 1 && i < parts; ++i)
        for (int j = 0; i + j < parts; ++j)
          add(t, (float(i) + 1 / 3.0F) / float(parts), (float(j) + 1 / 3.0F) / float(parts));
    }
  };
  std::size_t count = 0;
  visit([&](const Triangle&, float, float) { ++count; });
  dense.vertices_mm.reserve(count);
  dense.normals.reserve(count);
  dense.sigma_mm.reserve(count);
  visit([&](const Triangle& t, float u, float v) {
    const auto mixed = [&](const auto& of) {
      return plus(times(of[t[0]], 1 - u - v), plus(times(of[t[1]], u), times(of[t[2]], v)));
    };
    dense.vertices_mm.push_back(mixed(base.vertices_mm));
    dense.normals.push_back(unit(mixed(base.normals)));
    dense.sigma_mm.push_back(std::max({base.sigma_mm[t[0]], base.sigma_mm[t[1]], base.sigma_mm[t[2]]}));
  });
  return dense;
}

Result<FaceMesh> finish_surface(const FaceMesh& base, std::span<const Vec3f> vertices,
                                std::pmr::vector<Triangle>& triangles, const FinishOptions& options,
                                StageContext& context) {
  const auto carried = carry_over(base, vertices, options, context);
  if (context.stop()) return stopped();
  const float max_slope = float(std::tan(options.max_incidence_deg * std::numbers::pi / 180));
  const float min_cosine = cosine_of_slope(max_slope);
  std::erase_if(triangles,
                [&](const Triangle& t) { return !carried[t[0]] || !carried[t[1]] || !carried[t[2]]; });
  keep_one_surface(vertices, triangles, {}, &context.scratch);
  // Slivers first: the way a triangle almost without area faces says nothing.
  const auto mend = [&](float slope) {
    if (mend_slivers(vertices, triangles, slope, &context.scratch) > 0)
      keep_one_surface(vertices, triangles, {.ear_passes = 0}, &context.scratch);
  };
  mend(kAnySlope);
  std::erase_if(triangles, [&](const Triangle& t) {
    return !facing(vertices[t[0]], vertices[t[1]], vertices[t[2]], min_cosine);
  });
  keep_one_surface(vertices, triangles, {}, &context.scratch);
  const std::size_t most = std::size_t(options.max_triangles);
  if (triangles.size() > most) collapse_edges(vertices, triangles, most, {}, &context.scratch);
  mend(max_slope);
  if (context.stop()) return stopped();
  if (triangles.empty() || area_mm2(vertices, triangles) < options.min_area_mm2) return no_surface();
  if (triangles.size() > most)
    return invalid("the surface cannot be simplified to so few triangles: allow more").at("max_triangles");
  FaceMesh mesh = pack_mesh(vertices.size(), triangles, context, [&](std::size_t v) {
    return PackedVertex{vertices[v], carried[v]->sigma_mm, carried[v]->measured};
  });
  compute_normals(mesh, 1, &context.scratch);
  context.progress.done.store(1, std::memory_order_relaxed);
  return mesh;
}

DepthSamples sample_depths(const FaceMesh& base, std::pmr::memory_resource* memory) {
  DepthSamples samples(memory);
  const std::size_t n = base.vertices_mm.size();
  for (auto* values : {&samples.u, &samples.v, &samples.depth, &samples.sigma}) values->reserve(n);
  for (const Vec3f& p : base.vertices_mm) samples.usual_depth_mm += double(p.z) / double(n);
  samples.left = samples.top = 1e9;
  samples.right = samples.bottom = -1e9;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3f& p = base.vertices_mm[i];
    const double z = double(p.z);
    samples.u.push_back(samples.usual_depth_mm * double(p.x) / z);
    samples.v.push_back(samples.usual_depth_mm * double(p.y) / z);
    samples.depth.push_back(z);
    // The base's sigma is perpendicular; along the line of sight it is larger where the surface is steep.
    const double cosine = std::abs(double(dot(base.normals[i], unit(p))));
    samples.sigma.push_back(double(base.sigma_mm[i]) / std::max(cosine, 0.1));
    samples.left = std::min(samples.left, samples.u.back());
    samples.right = std::max(samples.right, samples.u.back());
    samples.top = std::min(samples.top, samples.v.back());
    samples.bottom = std::max(samples.bottom, samples.v.back());
  }
  return samples;
}

Result<FaceMesh> mesh_sheet(const FaceMesh& base, const DepthSamples& samples, const DepthFunction& function,
                            const SheetOptions& options, StageContext& context) {
  const NearestVertex nearest(base.vertices_mm, &context.scratch);
  const int rows = int((samples.bottom - samples.top) / options.step_mm) + 1;
  const std::size_t columns = std::size_t(int((samples.right - samples.left) / options.step_mm) + 1);
  const auto u_of = [&](std::size_t column) { return samples.left + options.step_mm * double(column); };
  const auto v_of = [&](int row) { return samples.top + options.step_mm * row; };
  std::pmr::vector<double> depths(columns * std::size_t(rows), 0.0, &context.scratch);
  context.pool.for_each(rows, kBands, [&](int r) {
    if (context.stop()) return;
    for (std::size_t c = 0; c < columns; ++c)
      depths[std::size_t(r) * columns + c] = function(u_of(c), v_of(r));
  });
  if (context.stop()) return stopped();
  const float usual = usual_edge_mm(base.vertices_mm, base.triangles, &context.scratch);
  const float reach = kReachEdges * std::max(usual, float(options.step_mm));
  PointCloud cloud(&context.scratch);
  cloud.points.reserve(depths.size());
  cloud.lattice_step_px = 1;
  // Of the nodes those near a measured point, on its tangent plane but for the tolerance.
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (!std::isfinite(depths[i]) || depths[i] <= 0) continue;
    const std::size_t c = i % columns;
    const int r = int(i / columns);
    const Vec3f at{float(u_of(c) / samples.usual_depth_mm * depths[i]),
                   float(v_of(r) / samples.usual_depth_mm * depths[i]), float(depths[i])};
    const auto hit = nearest.find(at, 3 * reach + 2 * kDisagreeMm);
    if (hit.vertex == NearestVertex::kNone) continue;
    const Vec3f from = minus(at, base.vertices_mm[hit.vertex]);
    const float off = std::abs(dot(from, base.normals[hit.vertex]));
    if (off > kDisagreeMm + kDisagreeSigmas * base.sigma_mm[hit.vertex] ||
        hit.squared_mm - off * off > reach * reach)
      continue;
    cloud.points.push_back({at, {float(c), float(r)}, float(samples.sigma[hit.vertex])});
  }
  GridMesher joining;
  joining.max_triangles = options.max_triangles;
  joining.min_area_mm2 = options.min_area_mm2;
  return joining.mesh(cloud, context);
}

}  // namespace relievo::pipeline

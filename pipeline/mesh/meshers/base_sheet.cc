// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/meshers/base_sheet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/mesh/detail/corner_index.h"
#include "pipeline/mesh/detail/edge_collapser.h"
#include "pipeline/mesh/detail/sliver_mender.h"
#include "pipeline/mesh/lattice/lattice_surface.h"
#include "pipeline/mesh/meshers/nearest_vertex.h"
#include "pipeline/mesh/vector_math.h"

namespace relievo::pipeline {
namespace {

constexpr float kMeasuredEdges =
    1.5F;  // so many usual edges from a measured point a vertex counts as measured
constexpr float kAnySlope = 1e6F;
constexpr float kBeyondEdges = 0.3F;  // and so many beyond the border it may lie
constexpr float kSigmaPerMm = 0.05F;  // what a vertex further from the points loses in certainty

struct Carried {
  explicit Carried(std::pmr::memory_resource* memory) : sigma_mm(memory), measured(memory), near(memory) {}
  std::pmr::vector<float> sigma_mm;
  std::pmr::vector<std::uint8_t> measured, near;
};

// 1 at vertices of the base's own border.
std::pmr::vector<std::uint8_t> border_of(const FaceMesh& base, std::pmr::memory_resource* memory) {
  std::pmr::vector<Triangle> triangles(base.triangles, memory);
  CornerIndex index(base.vertices_mm.size(), triangles, memory);
  index.build();
  std::pmr::vector<std::uint8_t> border(base.vertices_mm.size(), 0, memory);
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (index.across(t[k], t[(k + 1) % 3]) == kGoneVertex) border[t[k]] = border[t[(k + 1) % 3]] = 1;
  return border;
}

Carried carry_over(const FaceMesh& base, std::span<const Vec3f> vertices, const FinishOptions& options,
                   StageContext& context) {
  const NearestVertex nearest(base.vertices_mm, &context.scratch);
  const auto border = border_of(base, &context.scratch);
  const float usual = usual_edge_mm(base, &context.scratch);
  Carried carried(&context.scratch);
  carried.sigma_mm.assign(vertices.size(), 0.0F);
  carried.measured.assign(vertices.size(), 0);
  carried.near.assign(vertices.size(), 0);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (!(vertices[v].z > 0)) continue;
    const auto hit = nearest.find(vertices[v], static_cast<float>(options.max_gap_mm));
    if (hit.vertex == NearestVertex::kNone) continue;
    const float distance = std::sqrt(hit.squared_mm);
    if (border[hit.vertex] && distance > kBeyondEdges * usual)
      continue;  // nothing grows over the measured border
    carried.near[v] = 1;
    carried.measured[v] = base.measured[hit.vertex] && distance <= kMeasuredEdges * usual;
    carried.sigma_mm[v] = base.sigma_mm[hit.vertex] + kSigmaPerMm * std::max(distance - usual, 0.0F);
  }
  return carried;
}

}  // namespace

Result<FaceMesh> base_sheet(const PointCloud& cloud, int most_points, StageContext& context) {
  StageContext inner{context.scratch, context.scratch, context.pool, context.progress, context.cancelled};
  return delaunay_sheet(cloud, std::max(2 * most_points, 1000), inner);
}

float usual_edge_mm(const FaceMesh& base, std::pmr::memory_resource* memory) {
  std::pmr::vector<float> lengths(memory);
  lengths.reserve(base.triangles.size());
  for (const Triangle& t : base.triangles)
    lengths.push_back(mesh::length(mesh::minus(base.vertices_mm[t[1]], base.vertices_mm[t[0]])));
  if (lengths.empty()) return 0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

FaceMesh densify(const FaceMesh& base, float spacing_mm, std::pmr::memory_resource* memory) {
  FaceMesh dense(memory);
  const auto visit = [&](auto&& add) {
    for (const Triangle& t : base.triangles) {
      const Vec3f &a = base.vertices_mm[t[0]], &b = base.vertices_mm[t[1]], &c = base.vertices_mm[t[2]];
      const float longest = std::sqrt(std::max(
          {mesh::squared_distance(a, b), mesh::squared_distance(b, c), mesh::squared_distance(c, a)}));
      const int parts = static_cast<int>(std::ceil(longest / spacing_mm));
      for (int i = 0; parts > 1 && i < parts; ++i)
        for (int j = 0; i + j < parts; ++j)
          add(t, (static_cast<float>(i) + 1 / 3.0F) / static_cast<float>(parts),
              (static_cast<float>(j) + 1 / 3.0F) / static_cast<float>(parts));
    }
  };
  std::size_t count = 0;
  visit([&](const Triangle&, float, float) { ++count; });
  dense.vertices_mm.reserve(count);
  dense.normals.reserve(count);
  dense.sigma_mm.reserve(count);
  visit([&](const Triangle& t, float u, float v) {
    const auto mixed = [&](const auto& of) {
      return mesh::plus(mesh::times(of[t[0]], 1 - u - v),
                        mesh::plus(mesh::times(of[t[1]], u), mesh::times(of[t[2]], v)));
    };
    dense.vertices_mm.push_back(mixed(base.vertices_mm));
    dense.normals.push_back(mesh::unit(mixed(base.normals)));
    dense.sigma_mm.push_back(std::max({base.sigma_mm[t[0]], base.sigma_mm[t[1]], base.sigma_mm[t[2]]}));
  });
  return dense;
}

Result<void> FinishOptions::check(const char* place) const {
  if (max_triangles < 1000 || max_triangles > 10'000'000)
    return Error{Errc::InvalidInput, "max_triangles must lie in 1000 .. 10000000"}.at(place);
  if (!(max_gap_mm >= 0.1 && max_gap_mm <= 50))
    return Error{Errc::InvalidInput, "max_gap_mm must lie in 0.1 .. 50"}.at(place);
  if (!(max_incidence_deg >= 30 && max_incidence_deg <= 89))
    return Error{Errc::InvalidInput, "max_incidence_deg must lie in 30 .. 89"}.at(place);
  if (!(min_area_mm2 >= 0 && min_area_mm2 <= 1e6))
    return Error{Errc::InvalidInput, "min_area_mm2 must lie in 0 .. 1000000"}.at(place);
  return {};
}

Result<FaceMesh> finish_surface(const FaceMesh& base, std::span<const Vec3f> vertices,
                                std::pmr::vector<Triangle>& triangles, const FinishOptions& options,
                                StageContext& context) {
  const Carried carried = carry_over(base, vertices, options, context);
  if (context.stop()) return Error{Errc::Cancelled, "meshing was stopped"};
  const float max_slope = static_cast<float>(std::tan(options.max_incidence_deg * std::numbers::pi / 180));
  const float min_cosine = cosine_of_slope(max_slope);
  std::erase_if(triangles, [&](const Triangle& t) {
    return !carried.near[t[0]] || !carried.near[t[1]] || !carried.near[t[2]];
  });
  keep_one_surface(vertices, triangles, {}, &context.scratch);
  // Slivers first: the way a triangle almost without area faces says nothing.
  const auto mend = [&](float slope) {
    if (mend_slivers(vertices, triangles, {kSmallestAngleDeg, slope}, &context.scratch) > 0)
      keep_one_surface(vertices, triangles, {.ear_passes = 0}, &context.scratch);
  };
  mend(kAnySlope);
  std::erase_if(triangles, [&](const Triangle& t) {
    return !facing(vertices[t[0]], vertices[t[1]], vertices[t[2]], min_cosine);
  });
  keep_one_surface(vertices, triangles, {}, &context.scratch);
  const std::size_t most = static_cast<std::size_t>(options.max_triangles);
  if (triangles.size() > most) collapse_edges(vertices, triangles, most, {}, &context.scratch);
  mend(max_slope);
  if (context.stop()) return Error{Errc::Cancelled, "meshing was stopped"};
  // What cannot be simplified that far is more than a kiosk can hold.
  if (triangles.size() > most || triangles.empty() || area_mm2(vertices, triangles) < options.min_area_mm2)
    return no_surface();
  FaceMesh mesh = pack_mesh(vertices.size(), triangles, context, [&](std::size_t v) {
    return PackedVertex{vertices[v], carried.sigma_mm[v], carried.measured[v]};
  });
  compute_normals(mesh, 1, &context.scratch);
  context.progress.done.store(1, std::memory_order_relaxed);
  return mesh;
}

}  // namespace relievo::pipeline

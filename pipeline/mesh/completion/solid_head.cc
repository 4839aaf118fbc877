// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/solid_head.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "pipeline/mesh/completion/head_sewing.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

// Above the lowest point of the usual head's neck, whose foot is rounded over 12 mm.
constexpr double kStumpMm = 14;
constexpr double kLeastFootMm2 = 2000;  // of a neck

Vec3d in_head(const FaceModel& model, const Vec3f& v) { return apply(model.head_from_camera, wide(v)); }

// The part of the mesh above the height, its border on the plane.
FaceMesh above(const FaceMesh& mesh, std::span<const double> height, double cut, Arena& memory) {
  FaceMesh part(&memory);
  part.vertices_mm.reserve(mesh.vertices_mm.size()), part.sigma_mm.reserve(mesh.vertices_mm.size());
  part.measured.reserve(mesh.vertices_mm.size()), part.triangles.reserve(mesh.triangles.size());
  std::vector<std::uint32_t> place(mesh.vertices_mm.size(), ~std::uint32_t{0});
  const auto kept = [&](std::uint32_t v) {
    if (place[v] == ~std::uint32_t{0})
      place[v] = add_vertex(part, {mesh.vertices_mm[v], mesh.sigma_mm[v], mesh.measured[v]});
    return place[v];
  };
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> on_edge;
  const auto crossing = [&](std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);  // whichever triangle asks: the same place
    const auto [at, fresh] = on_edge.try_emplace({a, b}, std::uint32_t(part.vertices_mm.size()));
    if (fresh) {
      const float share = float((cut - height[a]) / (height[b] - height[a]));
      const Vec3f& p = mesh.vertices_mm[a];
      add_vertex(part, {plus(p, times(minus(mesh.vertices_mm[b], p), share)),
                        std::max(mesh.sigma_mm[a], mesh.sigma_mm[b]), 0});
    }
    return at->second;
  };
  const auto is_above = [&](std::uint32_t v) { return height[v] >= cut; };
  for (const Triangle& t : mesh.triangles) {
    std::vector<std::uint32_t> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (is_above(a)) corners.push_back(kept(a));
      if (is_above(a) != is_above(b)) corners.push_back(crossing(a, b));
    }
    for (std::size_t k = 2; k < corners.size(); ++k)
      part.triangles.push_back({corners[0], corners[k - 1], corners[k]});
  }
  return part;
}

// Where the closed surface touches itself at a vertex, each of its sides gets that vertex for itself.
void part_touching(FaceMesh& mesh) {
  std::vector<std::vector<std::uint32_t>> around(mesh.vertices_mm.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) around[v].push_back(t);
  const std::size_t before = around.size();
  for (std::uint32_t v = 0; v < before; ++v) {
    std::vector<std::uint32_t>& left = around[v];
    for (bool first = true; !left.empty(); first = false) {
      const std::uint32_t name =
          first ? v : add_vertex(mesh, {mesh.vertices_mm[v], mesh.sigma_mm[v], mesh.measured[v]});
      // From triangle to triangle once around.
      auto next = left.begin();
      while (next != left.end()) {
        Triangle& t = mesh.triangles[*next];
        left.erase(next);
        const auto k = std::size_t(std::ranges::find(t, v) - t.begin());
        const std::uint32_t onward = t[(k + 2) % 3];
        t[k] = name;
        next = std::ranges::find_if(left, [&](std::uint32_t other) {
          const Triangle& o = mesh.triangles[other];
          const auto at = std::size_t(std::ranges::find(o, v) - o.begin());
          return o[(at + 1) % 3] == onward;
        });
      }
    }
  }
}

// Every edge is run once in each direction.
bool is_closed(const FaceMesh& mesh) {
  const auto edges = directed_edges(mesh.triangles, std::pmr::get_default_resource());
  return std::ranges::adjacent_find(edges) == edges.end() &&
         border_edges(mesh.triangles, edges.get_allocator().resource()).empty();
}

double foot_mm2(const FaceModel& model, const FaceMesh& solid, double cut) {
  double area = 0;
  for (const Triangle& t : solid.triangles) {
    std::array<Vec3d, 3> at;
    for (std::size_t k = 0; k < 3; ++k) at[k] = in_head(model, solid.vertices_mm[t[k]]);
    if (std::max({at[0].y, at[1].y, at[2].y}) > cut + 0.01) continue;
    area +=
        std::abs((at[1].x - at[0].x) * (at[2].z - at[0].z) - (at[1].z - at[0].z) * (at[2].x - at[0].x)) / 2;
  }
  return area;
}

}  // namespace

Result<FaceMesh> make_solid(const FaceModel& model, const Completion& completion, StageContext& context) {
  return run_stage(context, [&](StageContext& c) -> Result<FaceMesh> {
    const RigidTransform back = inverse(model.head_from_camera);
    const Vec3d across = apply(RigidTransform{back.rotation, {}}, Vec3d{1, 0, 0});
    RELIEVO_TRY_ASSIGN(const FaceMesh head, completion(FaceMesh(model.mesh), across, c));
    if (!is_closed(head))  // nothing was added
      return Error{
          Errc::PoorGeometry,
          "no head is found in it: no solid can be made of it; take the picture again from in front"};
    std::vector<double> height;
    height.reserve(head.vertices_mm.size());
    double lowest = 0;
    for (std::size_t v = 0; v < head.vertices_mm.size(); ++v) {
      height.push_back(in_head(model, head.vertices_mm[v]).y);
      if (head.measured[v] == 0) lowest = std::min(lowest, height.back());
    }
    // Where a cut meets a fold of the surface, one a little higher may not.
    for (const double higher_mm : {0.0, 4.0, 8.0, 12.0}) {
      const double cut = lowest + kStumpMm + higher_mm;
      FaceMesh solid = above(head, height, cut, c.output);
      keep_one_surface(solid.vertices_mm, solid.triangles, {0}, &c.scratch);
      fan_holes(solid, c.scratch);
      part_touching(solid);
      if (!is_closed(solid) || foot_mm2(model, solid, cut) < kLeastFootMm2) continue;
      compute_normals(solid, 1, &c.scratch);
      return solid;
    }
    return Error{Errc::PoorGeometry,
                 "the head does not close to a solid: take the picture again from in front"};
  });
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/head_sewing.h"

#include <algorithm>
#include <utility>

#include "pipeline/mesh/completion/mesh_laplacian.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

// What the gap's triangles may be: of short edges, none of which the surface has already; where the border
// folds in the plane, its wrong side was reached.
bool fits(const FaceMesh& mesh, std::span<const BorderEdge> own, const Triangle& t, double longest_mm) {
  for (std::size_t k = 0; k < 3; ++k) {
    const BorderEdge edge{t[k], t[(k + 1) % 3]};
    const float squared = squared_distance(mesh.vertices_mm[edge[0]], mesh.vertices_mm[edge[1]]);
    if (double(squared) > longest_mm * longest_mm) return false;
    if (std::ranges::binary_search(own, edge)) return false;
  }
  return true;
}

// What was added goes on from what was there without a crease: the plate over the globe knows nothing of skin
// that stands upright on it.
void fair_seam(FaceMesh& mesh, std::size_t own, double width_mm) {
  std::vector<Eigen::Vector3d> at;
  for (const Vec3f& v : mesh.vertices_mm) at.emplace_back(v.x, v.y, v.z);
  std::vector<double> away(at.size(), width_mm);
  for (std::size_t v = 0; v < own; ++v) away[v] = 0;
  for (bool nearer = true; nearer;) {
    nearer = false;
    for (const auto& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        if (a < own && b < own) continue;
        const double step = (at[a] - at[b]).norm();
        if (away[a] > away[b] + step) away[a] = away[b] + step, nearer = true;
        if (away[b] > away[a] + step) away[b] = away[a] + step, nearer = true;
      }
  }
  std::vector<char> free(at.size());
  for (std::size_t v = own; v < at.size(); ++v) free[v] = away[v] < width_mm ? 1 : 0;
  fair(at, mesh.triangles, free);
  for (std::size_t v = own; v < at.size(); ++v)
    if (free[v] != 0) {
      const Eigen::Vector3f p = at[v].cast<float>();
      mesh.vertices_mm[v] = {p.x(), p.y(), p.z()};
    }
}

}  // namespace

void fan_holes(FaceMesh& mesh, Arena& scratch) {
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::pmr::vector<std::uint32_t> next(mesh.vertices_mm.size(), kNone, &scratch);
  for (const auto& [from, to] : border_edges(mesh.triangles, &scratch)) next[to] = from;
  std::pmr::vector<std::uint32_t> loop(&scratch);
  for (std::uint32_t start = 0; start < next.size(); ++start) {
    loop.clear();
    for (std::uint32_t v = start; next[v] != kNone; v = std::exchange(next[v], kNone)) loop.push_back(v);
    if (loop.empty()) continue;
    if (loop.size() == 3) {
      mesh.triangles.push_back({loop[0], loop[1], loop[2]});
      continue;
    }
    Vec3f middle{};
    float sigma = 0;
    for (const std::uint32_t v : loop) {
      middle = plus(middle, times(mesh.vertices_mm[v], 1 / float(loop.size())));
      sigma = std::max(sigma, mesh.sigma_mm[v]);
    }
    const std::uint32_t centre = add_vertex(mesh, {middle, sigma, 0});
    for (std::size_t k = 0; k < loop.size(); ++k)
      mesh.triangles.push_back({loop[k], loop[(k + 1) % loop.size()], centre});
  }
}

FaceMesh sew(const FaceMesh& mesh, std::span<const Vec3f> flat, std::span<const Addition> added,
             const SewingRules& rules, StageContext& context) {
  FaceMesh whole(&context.scratch);
  whole = mesh;  // keeps its own memory
  const auto add = [&whole](const Addition& a) { return add_vertex(whole, {a.at_mm, a.sigma_mm, 0}); };
  std::pmr::vector<Vec2f> places(&context.scratch);
  places.reserve(mesh.vertices_mm.size() + added.size());
  for (const Vec3f& v : flat) places.push_back({v.x, v.y});
  std::pmr::vector<std::uint32_t> fresh(&context.scratch);
  for (const Addition& a : added) {
    fresh.push_back(add(a));
    places.push_back(a.plane);
  }
  std::optional<std::uint32_t> far_point;
  if (rules.far_point) far_point = add(*rules.far_point);
  const auto border = border_edges(mesh.triangles, &context.scratch);
  const auto own = directed_edges(mesh.triangles, &context.scratch);
  const auto gap = triangulate_gap(places, border, fresh, far_point, &context.scratch);
  for (const Triangle& t : gap)
    if (fits(whole, own, t, rules.longest_edge_mm)) whole.triangles.push_back(t);
  keep_one_surface(whole.vertices_mm, whole.triangles, {0}, &context.scratch);
  // Where the border folds in the plane some of it stays open.
  if (far_point) fan_holes(whole, context.scratch);
  if (rules.faired_mm > 0 && !context.stop()) fair_seam(whole, mesh.vertices_mm.size(), rules.faired_mm);
  compute_normals(whole, 1, &context.scratch);
  for (std::size_t v = 0; v < mesh.normals.size(); ++v)
    if (mesh.measured[v] != 0) whole.normals[v] = mesh.normals[v];
  return pack_mesh(whole.vertices_mm.size(), whole.triangles, context, [&](std::size_t v) {
    return PackedVertex{whole.vertices_mm[v], whole.sigma_mm[v], whole.measured[v], whole.normals[v]};
  });
}

}  // namespace relievo::pipeline

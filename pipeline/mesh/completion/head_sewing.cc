// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/head_sewing.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "pipeline/mesh/completion/gap_triangulation.h"
#include "pipeline/mesh/completion/mesh_laplacian.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

using Edge = std::array<std::uint32_t, 2>;

// Directed edges that one triangle alone has.
std::pmr::vector<Edge> border_of(const FaceMesh& mesh, Arena& scratch) {
  struct Half {
    Edge key;
    Edge as_run;
  };
  std::pmr::vector<Half> all(&scratch);
  all.reserve(mesh.triangles.size() * 3);
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge e{t[k], t[(k + 1) % 3]};
      all.push_back({{std::min(e[0], e[1]), std::max(e[0], e[1])}, e});
    }
  std::ranges::sort(all, [](const Half& l, const Half& r) { return l.key < r.key; });
  std::pmr::vector<Edge> border(&scratch);
  for (std::size_t i = 0; i < all.size();) {
    std::size_t j = i + 1;
    while (j < all.size() && all[j].key == all[i].key) ++j;
    if (j - i == 1) border.push_back(all[i].as_run);
    i = j;
  }
  return border;
}

std::pmr::vector<Edge> directed_edges(const FaceMesh& mesh, Arena& scratch) {
  std::pmr::vector<Edge> edges(&scratch);
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) edges.push_back({t[k], t[(k + 1) % 3]});
  std::ranges::sort(edges);
  return edges;
}

// What the gap's triangles may be: of short edges, none of which the surface has already; where the border
// folds in the plane, its wrong side was reached.
bool fits(const FaceMesh& mesh, std::span<const Edge> own, const Triangle& t, double longest_mm) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Edge edge{t[k], t[(k + 1) % 3]};
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
  for (const Vec3f& v : mesh.vertices_mm) at.push_back(Eigen::Vector3f(v.x, v.y, v.z).cast<double>());
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

// Vertices that no triangle uses go; the order of the rest stays.
FaceMesh compacted(const FaceMesh& mesh, Arena& output, Arena& scratch) {
  std::pmr::vector<std::uint32_t> place(mesh.vertices_mm.size(), 0, &scratch);
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t) place[v] = 1;
  std::uint32_t count = 0;
  for (std::uint32_t& p : place) p = p != 0 ? ++count : 0;
  FaceMesh out(&output);
  out.vertices_mm.reserve(count), out.normals.reserve(count), out.sigma_mm.reserve(count),
      out.measured.reserve(count);
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (place[v] == 0) continue;
    out.vertices_mm.push_back(mesh.vertices_mm[v]);
    out.normals.push_back(mesh.normals[v]);
    out.sigma_mm.push_back(mesh.sigma_mm[v]);
    out.measured.push_back(mesh.measured[v]);
  }
  out.triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    out.triangles.push_back({place[t[0]] - 1, place[t[1]] - 1, place[t[2]] - 1});
  return out;
}

}  // namespace

void fan_holes(FaceMesh& mesh, Arena& scratch) {
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::pmr::vector<std::uint32_t> next(mesh.vertices_mm.size(), kNone, &scratch);
  for (const auto& [from, to] : border_of(mesh, scratch)) next[to] = from;
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
    const auto centre = std::uint32_t(mesh.vertices_mm.size());
    mesh.vertices_mm.push_back(middle);
    mesh.sigma_mm.push_back(sigma);
    mesh.measured.push_back(0);
    for (std::size_t k = 0; k < loop.size(); ++k)
      mesh.triangles.push_back({loop[k], loop[(k + 1) % loop.size()], centre});
  }
}

FaceMesh sew(const FaceMesh& mesh, std::span<const Vec2f> plane, std::span<const Addition> added,
             const SewingRules& rules, StageContext& context) {
  FaceMesh whole(&context.scratch);
  whole.vertices_mm.assign(mesh.vertices_mm.begin(), mesh.vertices_mm.end());
  whole.sigma_mm.assign(mesh.sigma_mm.begin(), mesh.sigma_mm.end());
  whole.measured.assign(mesh.measured.begin(), mesh.measured.end());
  whole.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
  const auto add = [&whole](const Addition& a) {
    whole.vertices_mm.push_back(a.at_mm);
    whole.sigma_mm.push_back(a.sigma_mm);
    whole.measured.push_back(0);
    return std::uint32_t(whole.vertices_mm.size() - 1);
  };
  std::pmr::vector<Vec2f> places(plane.begin(), plane.end(), &context.scratch);
  std::pmr::vector<std::uint32_t> fresh(&context.scratch);
  for (const Addition& a : added) {
    fresh.push_back(add(a));
    places.push_back(a.plane);
  }
  std::optional<std::uint32_t> far_point;
  if (rules.far_point) far_point = add(*rules.far_point);
  const auto border = border_of(mesh, context.scratch);
  const auto own = directed_edges(mesh, context.scratch);
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
  return compacted(whole, context.output, context.scratch);
}

}  // namespace relievo::pipeline

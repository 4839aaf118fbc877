// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/head_sewing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "pipeline/mesh/completion/gap_triangulation.h"
#include "pipeline/mesh/landmarks/head_frame.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

Vec3f narrow(const Vec3d& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

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
  std::sort(all.begin(), all.end(), [](const Half& l, const Half& r) { return l.key < r.key; });
  std::pmr::vector<Edge> border(&scratch);
  for (std::size_t i = 0; i < all.size();) {
    std::size_t j = i + 1;
    while (j < all.size() && all[j].key == all[i].key) ++j;
    if (j - i == 1) border.push_back(all[i].as_run);
    i = j;
  }
  return border;
}

struct Addition {
  Vec3f at_mm;  // the camera's frame
  Vec2f plane;
  float sigma_mm;
};

// Not where the border's own triangles still lie.
std::pmr::vector<Addition> additions(const UnrolledHead& head, const RigidTransform& camera_from_head,
                                     double cell_mm, const SewingRules& rules, Arena& scratch) {
  std::pmr::vector<Addition> all(&scratch);
  for (int r = 0; r < head.own.rows(); ++r)
    for (int c = 0; c < head.own.columns(); ++c) {
      const float radius = head.added.z(c, r);
      const float away = head.distance_mm[head.index(c, r)];
      if (std::isnan(radius) || away < 1.5F * static_cast<float>(cell_mm)) continue;
      const double arc = head.own.x_mm(c), y = head.own.y_mm(r);
      const double sigma = rules.sigma ? static_cast<double>(rules.sigma->z(c, r))
                                       : rules.sigma_mm + rules.sigma_per_mm * static_cast<double>(away);
      all.push_back({narrow(apply(camera_from_head, rolled(arc, y, static_cast<double>(radius)))),
                     {static_cast<float>(arc), static_cast<float>(y)},
                     static_cast<float>(sigma)});
    }
  return all;
}

// What the gap's triangles may be: short edges, seen from outside, and no edge that the surface has already.
bool fits(const FaceMesh& mesh, const Triangle& t, float longest_mm) {
  for (std::size_t k = 0; k < 3; ++k)
    if (squared_distance(mesh.vertices_mm[t[k]], mesh.vertices_mm[t[(k + 1) % 3]]) > longest_mm * longest_mm)
      return false;
  return true;
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

FaceMesh joined(const FaceMesh& mesh, const UnrolledHead& head, std::span<const Addition> added,
                double longest_edge_mm, StageContext& context) {
  FaceMesh whole(&context.scratch);
  whole.vertices_mm.assign(mesh.vertices_mm.begin(), mesh.vertices_mm.end());
  whole.sigma_mm.assign(mesh.sigma_mm.begin(), mesh.sigma_mm.end());
  whole.measured.assign(mesh.measured.begin(), mesh.measured.end());
  whole.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
  std::pmr::vector<Vec2f> plane(&context.scratch);
  plane.reserve(mesh.vertices_mm.size() + added.size());
  for (const Vec3f& v : head.flat.vertices_mm) plane.push_back({v.x, v.y});
  std::pmr::vector<std::uint32_t> fresh(&context.scratch);
  for (const Addition& a : added) {
    fresh.push_back(static_cast<std::uint32_t>(whole.vertices_mm.size()));
    whole.vertices_mm.push_back(a.at_mm);
    whole.sigma_mm.push_back(a.sigma_mm);
    whole.measured.push_back(0);
    plane.push_back(a.plane);
  }
  const auto border = border_of(mesh, context.scratch);
  const auto gap = triangulate_gap(plane, border, fresh, &context.scratch);
  for (const Triangle& t : gap)
    if (fits(whole, t, static_cast<float>(longest_edge_mm))) whole.triangles.push_back(t);
  keep_one_surface(whole.vertices_mm, whole.triangles, {0}, &context.scratch);
  compute_normals(whole, 1, &context.scratch);
  for (std::size_t v = 0; v < mesh.normals.size(); ++v)
    if (mesh.measured[v] != 0) whole.normals[v] = mesh.normals[v];
  return compacted(whole, context.output, context.scratch);
}

}  // namespace

Result<FaceMesh> complete_head(FaceMesh mesh, const Vec3d& across, double cell_mm,
                               const std::function<SewingRules(UnrolledHead&)>& propose,
                               StageContext& context) {
  const Error stopped{Errc::Cancelled, "completion was stopped"};
  const Result<HeadFrame> frame = find_head_frame(mesh, context, across);
  if (!frame) {
    if (frame.error().code == Errc::PoorGeometry) return mesh;
    return frame.error();
  }
  const Arena::Mark mark(context.scratch);
  UnrolledHead head(mesh, frame->head_from_camera, cell_mm, context.scratch);
  if (context.stop()) return stopped;
  const SewingRules rules = propose(head);
  if (context.stop()) return stopped;
  const auto added = additions(head, inverse(frame->head_from_camera), cell_mm, rules, context.scratch);
  if (added.empty()) return mesh;
  return joined(mesh, head, added, rules.longest_edge_mm, context);
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/render/face_geometry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory_resource>
#include <queue>
#include <unordered_map>
#include <utility>

#include "hal/base/groups.h"
#include "pipeline/model/mesh_border.h"

namespace relievo::ui {
namespace {

constexpr float kMiddleBehindMm = 45;  // the head turns about a point behind the tip of its nose
constexpr float kFadeMm = 6;           // of the rim, into what stands behind

// How far from its border each vertex lies, in kFadeMm and no more than 1.
std::vector<float> within(const pipeline::FaceMesh& mesh) {
  const auto border = pipeline::border_vertices(mesh, std::pmr::get_default_resource());
  std::vector<float> share(border.size(), 1.0F);
  for (std::size_t v = 0; v < border.size(); ++v)
    if (border[v] != 0) share[v] = 0;
  const auto spread = [&](const std::array<std::uint32_t, 3>& t) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 1; j < 3; ++j) {
        const auto &a = mesh.vertices_mm[t[i]], &b = mesh.vertices_mm[t[(i + j) % 3]];
        if (share[t[i]] >= 1) continue;
        share[t[(i + j) % 3]] = std::min(share[t[(i + j) % 3]],
                                         share[t[i]] + std::hypot(a.x - b.x, a.y - b.y, a.z - b.z) / kFadeMm);
      }
  };
  for (int pass = 0; pass < 2; ++pass) {
    std::ranges::for_each(mesh.triangles, spread);
    std::for_each(mesh.triangles.rbegin(), mesh.triangles.rend(), spread);
  }
  return share;
}

}  // namespace

Dot dot_of(const pipeline::RigidTransform& t, const pipeline::Vec3f& v) {
  const auto p = apply(t, pipeline::Vec3d{v.x, v.y, v.z});
  return {float(p.x), float(p.y), float(p.z) + kMiddleBehindMm};
}

std::vector<Dot> dots_of(const pipeline::FaceModel& model, const pipeline::PointCloud* cloud) {
  std::vector<Dot> dots;
  if (cloud == nullptr)
    for (const auto& v : model.mesh.vertices_mm) dots.push_back(dot_of(model.head_from_camera, v));
  else
    for (const auto& p : cloud->points) dots.push_back(dot_of(model.head_from_camera, p.at_mm));
  return dots;
}

std::vector<Tinted> tinted_of(const pipeline::FaceModel& model) {
  const pipeline::Backdrop& b = model.backdrop;
  std::vector<Tinted> corners;
  const auto corner = [&](int c, int r) {
    const std::size_t k = std::size_t(r) * std::size_t(b.columns) + std::size_t(c);
    const Dot d = dot_of(model.head_from_camera, b.at_mm[k]);
    return Tinted{d.x, d.y, d.z, b.rgba[k]};
  };
  for (int r = 0; r + 1 < b.rows; ++r)
    for (int c = 0; c + 1 < b.columns; ++c) {
      const Tinted p = corner(c, r), q = corner(c + 1, r), o = corner(c, r + 1), d = corner(c + 1, r + 1);
      if ((p.rgba[3] | q.rgba[3] | o.rgba[3] | d.rgba[3]) != 0)
        corners.insert(corners.end(), {p, o, d, p, d, q});
    }
  return corners;
}

std::vector<Corner> corners_of(const pipeline::FaceModel& model, const pipeline::TextureAtlas& texture) {
  const auto& t = model.head_from_camera;
  const std::vector<float> share = within(model.mesh);
  std::vector<Corner> corners;
  corners.reserve(model.mesh.triangles.size() * 3);
  for (std::size_t i = 0; i < model.mesh.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t at = model.mesh.triangles[i][k];
      const auto& v = model.mesh.vertices_mm[at];
      const auto& n = model.mesh.normals[at];
      const Dot p = dot_of(t, v);
      const auto m = apply(t.rotation, pipeline::Vec3d{n.x, n.y, n.z});
      const bool flat = texture.uv.size() <= 3 * i + k;
      const pipeline::Vec2f uv = flat ? pipeline::Vec2f{} : texture.uv[3 * i + k];
      corners.push_back({p.x, p.y, p.z, float(m.x), float(m.y), float(m.z), uv.x, uv.y, share[at]});
    }
  }
  return corners;
}

namespace {

using pipeline::Vec3f;

float distance(const Vec3f& a, const Vec3f& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

// Vertices of which no two are nearer to each other than `least_mm`, and none of the others farther from all.
std::vector<std::uint32_t> spaced(const pipeline::FaceMesh& mesh, float least_mm) {
  const auto cell = [least_mm](float v) { return std::int64_t(std::floor(v / least_mm)) + (1 << 20); };
  const auto key = [](std::int64_t x, std::int64_t y, std::int64_t z) { return (x << 42) | (y << 21) | z; };
  std::unordered_multimap<std::int64_t, std::uint32_t> held;
  std::vector<std::uint32_t> chosen;
  const auto crowded = [&](const Vec3f& at) {
    const std::int64_t x = cell(at.x), y = cell(at.y), z = cell(at.z);
    for (std::int64_t k = 0; k < 27; ++k) {
      const auto [from, to] = held.equal_range(key(x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1));
      if (std::any_of(from, to, [&](const auto& entry) {
            return distance(mesh.vertices_mm[entry.second], at) < least_mm;
          }))
        return true;
    }
    return false;
  };
  for (std::uint32_t v = 0; v < mesh.vertices_mm.size(); ++v) {
    const Vec3f& at = mesh.vertices_mm[v];
    if (crowded(at)) continue;
    held.emplace(key(cell(at.x), cell(at.y), cell(at.z)), v);
    chosen.push_back(v);
  }
  return chosen;
}

// The neighbours of every vertex, one list after the other; each twice where two triangles share the side.
Groups neighbours_of(const pipeline::FaceMesh& mesh) {
  Groups neighbours;
  neighbours.sort(mesh.vertices_mm.size(), [&](auto&& add) {
    for (const auto& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 1; j < 3; ++j) add(t[i], t[(i + j) % 3]);
  });
  return neighbours;
}

// The chosen vertex that is nearest to each along the mesh.
std::vector<std::uint32_t> nearest(const pipeline::FaceMesh& mesh, const std::vector<std::uint32_t>& chosen) {
  const Groups neighbours = neighbours_of(mesh);
  const std::size_t count = mesh.vertices_mm.size();
  std::vector<std::uint32_t> owner(count);
  std::vector<float> far(count, HUGE_VALF);
  using Reached = std::pair<float, std::uint32_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
  for (const std::uint32_t v : chosen) {
    owner[v] = v;
    far[v] = 0;
    queue.emplace(0.0F, v);
  }
  while (!queue.empty()) {
    const auto [so_far, v] = queue.top();
    queue.pop();
    if (so_far > far[v]) continue;
    for (const std::uint32_t to : neighbours[v]) {
      const float reached = so_far + distance(mesh.vertices_mm[v], mesh.vertices_mm[to]);
      if (reached >= far[to]) continue;
      far[to] = reached;
      owner[to] = owner[v];
      queue.emplace(reached, to);
    }
  }
  for (std::uint32_t v = 0; v < count; ++v)
    if (far[v] == HUGE_VALF) owner[v] = v;  // a piece of the mesh that is smaller than the spacing
  return owner;
}

}  // namespace

Edges edges_of(const pipeline::FaceMesh& mesh, float least_mm) {
  const std::vector<std::uint32_t> owner = nearest(mesh, spaced(mesh, least_mm));
  Edges edges;
  for (const auto& t : mesh.triangles) {
    const std::uint32_t a = owner[t[0]], b = owner[t[1]], c = owner[t[2]];
    if (a == b || b == c || c == a) continue;
    for (const auto& [p, q] : {std::pair{a, b}, {b, c}, {c, a}})
      edges.push_back({std::min(p, q), std::max(p, q)});
  }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace relievo::ui

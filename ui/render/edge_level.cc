// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/render/edge_level.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <unordered_map>
#include <utility>

#include "hal/base/groups.h"

namespace relievo::ui {
namespace {

using pipeline::Vec3f;

float distance(const Vec3f& a, const Vec3f& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

// Vertices of which no two are nearer to each other than `least_mm`, and none of the others farther from all.
std::vector<std::uint32_t> spaced(const pipeline::FaceMesh& mesh, float least_mm) {
  const auto cell = [least_mm](float v) {
    return static_cast<std::int64_t>(std::floor(v / least_mm)) + (1 << 20);
  };
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
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace relievo::ui

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/rim.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr std::uint32_t kNobody = 0xFFFFFFFFU;
constexpr float kSlackMm = 0.6F;  // an opening leaves straight rims where they are

// How far every vertex lies from the nearest one that is marked, `most` where that is further: each learns of
// it from its neighbours (Danielsson 1980).
std::pmr::vector<float> distances(std::span<const Vec3f> vertices, std::span<const Triangle> triangles,
                                  const Groups& around, std::span<const std::uint8_t> marked, float most,
                                  std::pmr::memory_resource* memory) {
  std::pmr::vector<float> far(vertices.size(), most, memory);
  std::pmr::vector<std::uint32_t> nearest(vertices.size(), kNobody, memory), told(memory), next(memory);
  for (std::uint32_t v = 0; v < vertices.size(); ++v)
    if (marked[v] != 0) far[v] = 0, nearest[v] = v, told.push_back(v);
  for (; !told.empty(); std::swap(told, next), next.clear())
    for (const std::uint32_t v : told)
      for (const std::uint32_t t : around[v])
        for (const std::uint32_t other : triangles[t]) {
          if (far[other] <= 0 || nearest[other] == nearest[v]) continue;
          const float mm = distance(vertices[other], vertices[nearest[v]]);
          if (mm >= far[other]) continue;
          far[other] = mm;
          nearest[other] = nearest[v];
          next.push_back(other);
        }
  return far;
}

}  // namespace

void open_rims(std::span<const Vec3f> at, std::span<const std::uint8_t> sure,
               std::pmr::vector<Triangle>& triangles, float radius_mm, int holds,
               std::pmr::memory_resource* memory) {
  const std::size_t vertices = sure.size();
  std::pmr::vector<std::uint8_t> marked(vertices, 0, memory);
  for (const BorderEdge& e : border_edges(triangles, memory)) marked[e[0]] = marked[e[1]] = 1;
  Groups around(memory);
  group_around(around, vertices, triangles);
  const auto from_rim = distances(at, triangles, around, marked, radius_mm, memory);
  for (std::size_t v = 0; v < vertices; ++v) marked[v] = from_rim[v] >= radius_mm ? 1 : 0;
  const float far = radius_mm + kSlackMm;
  const auto from_core = distances(at, triangles, around, marked, far, memory);
  for (std::size_t v = 0; v < vertices; ++v) marked[v] = marked[v] != 0 || sure[v] != 0 ? 1 : 0;
  const auto from_sure = distances(at, triangles, around, marked, far, memory);
  // Parts beside the core, by one of their vertices each, and how many that are sure join each to it.
  std::pmr::vector<std::uint32_t> part(vertices, 0, memory);
  std::iota(part.begin(), part.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (part[v] != v) v = part[v] = part[part[v]];
    return v;
  };
  const auto is_in_core = [&](std::uint32_t v) { return from_core[v] < far; };
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (!is_in_core(t[k]) && !is_in_core(t[(k + 1) % 3])) part[root(t[k])] = root(t[(k + 1) % 3]);
  std::pmr::vector<BorderEdge> joined(memory);  // part, vertex
  for (const Triangle& t : triangles)
    for (const std::uint32_t a : t)
      for (const std::uint32_t b : t)
        if (!is_in_core(a) && is_in_core(b) && sure[b] != 0) joined.push_back({root(a), b});
  std::sort(joined.begin(), joined.end());
  joined.erase(std::unique(joined.begin(), joined.end()), joined.end());
  std::pmr::vector<int> held(vertices, 0, memory);
  for (const BorderEdge& j : joined) ++held[j[0]];
  std::erase_if(triangles, [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(), [&](std::uint32_t v) {
      return from_sure[v] >= far || (!is_in_core(v) && held[root(v)] < holds);
    });
  });
}

void smooth_rims(std::span<Vec3f> vertices, std::span<const BorderEdge> border, int rounds, float most_mm,
                 std::pmr::memory_resource* memory) {
  std::pmr::vector<std::uint32_t> next(vertices.size(), kNobody, memory),
      before(vertices.size(), kNobody, memory);
  for (const BorderEdge& e : border) {
    next[e[0]] = e[1];
    before[e[1]] = e[0];
  }
  const std::pmr::vector<Vec3f> first(vertices.begin(), vertices.end(), memory);
  std::pmr::vector<Vec3f> moved(first, memory);
  for (int round = 0; round < rounds; ++round) {
    for (const BorderEdge& e : border) {
      const std::uint32_t v = e[0];
      const Vec3f middle = times(plus(vertices[next[v]], vertices[before[v]]), 0.5F);
      const Vec3f way = minus(times(plus(vertices[v], middle), 0.5F), first[v]);
      const float far = length(way);
      moved[v] = along(first[v], far > most_mm ? most_mm / far : 1.0F, way);
    }
    for (const BorderEdge& e : border) vertices[e[0]] = moved[e[0]];
  }
}

void part_equals(std::span<Vec3f> vertices, std::span<const Vec3f> started,
                 std::pmr::memory_resource* memory) {
  std::pmr::vector<std::pair<std::array<float, 3>, std::uint32_t>> order(memory);
  order.reserve(vertices.size());
  for (std::uint32_t v = 0; v < vertices.size(); ++v)
    order.push_back({{vertices[v].x, vertices[v].y, vertices[v].z}, v});
  std::sort(order.begin(), order.end());
  for (std::size_t i = 1; i < order.size(); ++i)
    if (const std::uint32_t v = order[i].second; order[i].first == order[i - 1].first)
      vertices[v] = started[v];
}

}  // namespace relievo::pipeline

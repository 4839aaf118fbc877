// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/rim.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr std::uint32_t kNobody = 0xFFFFFFFFU;

// How many edges each vertex lies from those that are `at` 0; `most` and beyond is `most`.
void count_edges(std::span<const Triangle> triangles, int most, std::pmr::vector<std::uint8_t>& at) {
  for (int round = 0; round < most; ++round)
    for (const Triangle& t : triangles) {
      const auto next = std::uint8_t(std::min({at[t[0]], at[t[1]], at[t[2]]}) + 1);
      for (const std::uint32_t v : t) at[v] = std::min(at[v], next);
    }
}

}  // namespace

std::pmr::vector<BorderEdge> border_edges(std::span<const Triangle> triangles,
                                          std::pmr::memory_resource* memory) {
  // By the vertex of the lower number: of each of its edges the other end, doubled, and one more where the
  // triangle runs back from there.
  std::pmr::vector<std::uint32_t> begin(memory), ends(3 * triangles.size(), memory);
  const auto for_each_edge = [&](const auto& take) {
    for (const Triangle& t : triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t from = t[i], to = t[(i + 1) % 3];
        from < to ? take(from, 2 * to) : take(to, 2 * from + 1);
      }
  };
  for (const Triangle& t : triangles)
    begin.resize(std::max<std::size_t>({begin.size(), t[0] + 2UL, t[1] + 2UL, t[2] + 2UL}));
  for_each_edge([&](std::uint32_t low, std::uint32_t) { ++begin[low + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::pmr::vector<std::uint32_t> next(begin, memory);
  for_each_edge([&](std::uint32_t low, std::uint32_t end) { ends[next[low]++] = end; });
  std::pmr::vector<BorderEdge> border(memory);
  for (std::uint32_t low = 0; low + 1 < begin.size(); ++low) {
    const auto mine = std::span(ends).subspan(begin[low], begin[low + 1] - begin[low]);
    std::sort(mine.begin(), mine.end());
    for (std::size_t i = 0, after = 0; i < mine.size(); i = after) {
      while (after < mine.size() && mine[after] / 2 == mine[i] / 2) ++after;
      const std::uint32_t high = mine[i] / 2;
      if (after - i == 1) border.push_back(mine[i] % 2 == 0 ? BorderEdge{low, high} : BorderEdge{high, low});
    }
  }
  return border;
}

void open_rims(std::span<const std::uint8_t> sure, std::pmr::vector<Triangle>& triangles, int edges,
               int holds, std::pmr::memory_resource* memory) {
  const std::size_t vertices = sure.size();
  const auto far = std::uint8_t(edges);
  std::pmr::vector<std::uint8_t> from_rim(vertices, far, memory);
  for (const BorderEdge& e : border_edges(triangles, memory)) from_rim[e[0]] = from_rim[e[1]] = 0;
  count_edges(triangles, edges, from_rim);
  std::pmr::vector<std::uint8_t> from_core(vertices, std::uint8_t(far + 1), memory);
  for (std::size_t v = 0; v < vertices; ++v)
    if (from_rim[v] >= far) from_core[v] = 0;
  std::pmr::vector<std::uint8_t> from_sure(from_core, memory);
  count_edges(triangles, edges, from_core);
  for (std::size_t v = 0; v < vertices; ++v)
    if (sure[v] != 0) from_sure[v] = 0;
  count_edges(triangles, edges, from_sure);
  // Parts beside the core, by one of their vertices each, and how many that are sure join each to it.
  std::pmr::vector<std::uint32_t> part(vertices, 0, memory);
  std::iota(part.begin(), part.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (part[v] != v) v = part[v] = part[part[v]];
    return v;
  };
  const auto is_in_core = [&](std::uint32_t v) { return from_core[v] <= far; };
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
      return from_sure[v] > far || (!is_in_core(v) && held[root(v)] < holds);
    });
  });
}

void smooth_rims(std::span<Vec3f> vertices, std::span<const BorderEdge> border, int rounds, float most_mm,
                 std::pmr::memory_resource* memory) {
  std::pmr::vector<std::uint32_t> next(vertices.size(), kNobody, memory),
      before(vertices.size(), kNobody, memory);
  std::pmr::vector<std::uint8_t> shared(vertices.size(), 0, memory);
  for (const BorderEdge& e : border) {
    if (next[e[0]] != kNobody) shared[e[0]] = 1;
    if (before[e[1]] != kNobody) shared[e[1]] = 1;
    next[e[0]] = e[1];
    before[e[1]] = e[0];
  }
  const std::pmr::vector<Vec3f> first(vertices.begin(), vertices.end(), memory);
  std::pmr::vector<Vec3f> moved(first, memory);
  for (int round = 0; round < rounds; ++round) {
    for (const BorderEdge& e : border) {
      const std::uint32_t v = e[0];
      if (shared[v] != 0 || before[v] == kNobody) continue;
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
  std::pmr::vector<std::uint32_t> order(vertices.size(), 0, memory);
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t v) { return std::array{vertices[v].x, vertices[v].y, vertices[v].z}; };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  std::pmr::vector<std::uint32_t> second(memory);
  for (std::size_t i = 1; i < order.size(); ++i)
    if (key(order[i]) == key(order[i - 1])) second.push_back(order[i]);
  for (const std::uint32_t v : second) vertices[v] = started[v];
}

}  // namespace relievo::pipeline

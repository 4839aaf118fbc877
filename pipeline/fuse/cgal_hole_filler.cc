// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <set>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include "pipeline/fuse/rim.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

struct Loop {
  std::vector<std::uint32_t> vertices;
  float length_mm = 0;
};

BorderEdge edge_between(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

// Rims that pass through a vertex more than once are left open.
std::vector<Loop> loops_of(std::span<const Vec3f> vertices, std::span<const BorderEdge> border) {
  std::map<std::uint32_t, std::uint32_t> next;
  std::map<std::uint32_t, int> times;
  for (const BorderEdge& e : border) {
    next[e[0]] = e[1];
    ++times[e[0]];
  }
  std::vector<Loop> loops;
  while (!next.empty()) {
    Loop loop;
    bool plain = true;
    for (auto at = next.begin(); at != next.end();) {
      const auto [from, to] = *at;
      loop.vertices.push_back(from);
      loop.length_mm += distance(vertices[from], vertices[to]);
      plain = plain && times[from] == 1;
      next.erase(at);
      at = next.find(to);
    }
    if (!plain) loop.length_mm = 0;
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

std::vector<std::uint32_t> close_holes(std::span<const Vec3f> vertices, std::span<const BorderEdge> border,
                                       float most_mm, std::pmr::vector<Triangle>& triangles) {
  std::vector<Loop> loops = loops_of(vertices, border);
  const auto longest = std::max_element(
      loops.begin(), loops.end(), [](const Loop& a, const Loop& b) { return a.length_mm < b.length_mm; });
  std::vector<char> on_rim(vertices.size(), 0);
  for (const BorderEdge& e : border) on_rim[e[0]] = 1;
  std::set<BorderEdge> taken;  // edges between vertices of rims, low then high
  const auto take = [&](const Triangle& t) {
    for (std::size_t i = 0; i < 3; ++i)
      if (on_rim[t[i]] != 0 && on_rim[t[(i + 1) % 3]] != 0) taken.insert(edge_between(t[i], t[(i + 1) % 3]));
  };
  for (const Triangle& t : triangles) take(t);
  std::vector<std::uint32_t> closed;
  for (auto loop = loops.begin(); loop != loops.end(); ++loop) {
    if (loop == longest || loop->vertices.size() < 3 || loop->length_mm <= 0 || loop->length_mm > most_mm)
      continue;
    // The rim runs as its triangles do; what closes it runs the other way.
    std::reverse(loop->vertices.begin(), loop->vertices.end());
    std::vector<Kernel::Point_3> rim;
    for (const std::uint32_t v : loop->vertices)
      rim.emplace_back(vertices[v].x, vertices[v].y, vertices[v].z);
    std::vector<CGAL::Triple<int, int, int>> closing;
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(rim, std::back_inserter(closing));
    std::vector<Triangle> made;
    const auto at = [&](int i) { return loop->vertices[static_cast<std::size_t>(i)]; };
    for (const auto& t : closing) made.push_back({at(t.first), at(t.second), at(t.third)});
    std::set<BorderEdge> own;
    for (std::size_t i = 0; i < rim.size(); ++i)
      own.insert(edge_between(loop->vertices[i], loop->vertices[(i + 1) % rim.size()]));
    const auto is_free = [&](std::uint32_t a, std::uint32_t b) {
      return own.contains(edge_between(a, b)) || !taken.contains(edge_between(a, b));
    };
    const bool free = std::all_of(made.begin(), made.end(), [&](const Triangle& t) {
      return is_free(t[0], t[1]) && is_free(t[1], t[2]) && is_free(t[2], t[0]);
    });
    if (!free) continue;
    for (const Triangle& t : made) take(t);
    triangles.insert(triangles.end(), made.begin(), made.end());
    closed.insert(closed.end(), loop->vertices.begin(), loop->vertices.end());
  }
  return closed;
}

}  // namespace relievo::pipeline

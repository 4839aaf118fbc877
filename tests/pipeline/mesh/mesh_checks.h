// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every mesh must be, checked the slow and obvious way.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "pipeline/model/face_mesh.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

inline void expect_whole_arrays(const FaceMesh& m) {
  const std::size_t n = m.vertices_mm.size();
  EXPECT_EQ(m.normals.size(), n);
  EXPECT_EQ(m.sigma_mm.size(), n);
  EXPECT_EQ(m.measured.size(), n);
  std::vector<int> used(n, 0);
  for (const auto& t : m.triangles)
    for (const std::uint32_t v : t) {
      ASSERT_LT(v, n);
      used[v] = 1;
    }
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0) << "vertices without a triangle";
  for (std::size_t v = 0; v < n; ++v) {
    EXPECT_NEAR(length(m.normals[v]), 1, 1e-3);
    EXPECT_GE(m.sigma_mm[v], 0);
  }
}

// Every directed edge once (so: at most two triangles an edge, consistently wound), one fan a vertex,
// everything reached from the first triangle through edges.
inline void expect_one_manifold_surface(const FaceMesh& m) {
  std::map<Edge, std::size_t> triangle_at;
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge e{m.triangles[t][k], m.triangles[t][(k + 1) % 3]};
      EXPECT_NE(e.first, e.second);
      EXPECT_TRUE(triangle_at.emplace(e, t).second) << "an edge is used twice in one direction";
    }
  std::vector<char> reached(m.triangles.size(), 0);
  std::vector<std::size_t> stack{0};
  std::size_t count = 0;
  if (!reached.empty()) reached[0] = 1;
  while (!reached.empty() && !stack.empty()) {
    const std::size_t t = stack.back();
    stack.pop_back();
    ++count;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto other = triangle_at.find({m.triangles[t][(k + 1) % 3], m.triangles[t][k]});
      if (other == triangle_at.end() || reached[other->second]) continue;
      reached[other->second] = 1;
      stack.push_back(other->second);
    }
  }
  EXPECT_EQ(count, m.triangles.size()) << "more than one component";
  // A manifold boundary vertex has exactly one boundary edge leaving it, an inner one none.
  std::map<std::uint32_t, int> leaving;
  for (const auto& [edge, t] : triangle_at)
    if (triangle_at.find({edge.second, edge.first}) == triangle_at.end()) ++leaving[edge.first];
  for (const auto& [vertex, n] : leaving) EXPECT_EQ(n, 1) << "bow-tie at vertex " << vertex;
}

// Seen from the camera at the origin the winding is counter-clockwise, and normals agree with it.
inline void expect_facing_the_camera(const FaceMesh& m) {
  for (const auto& t : m.triangles) {
    const Vec3f& a = m.vertices_mm[t[0]];
    const Vec3f n = cross(minus(m.vertices_mm[t[1]], a), minus(m.vertices_mm[t[2]], a));
    EXPECT_LT(dot(n, a), 0);
  }
  for (std::size_t v = 0; v < m.normals.size(); ++v) EXPECT_LT(dot(m.normals[v], m.vertices_mm[v]), 0);
}

inline void expect_clean(const FaceMesh& m) {
  expect_whole_arrays(m);
  expect_one_manifold_surface(m);
  expect_facing_the_camera(m);
}

// Of all triangles, by arc cosines.
inline double smallest_angle_deg(const FaceMesh& m) {
  double smallest = 180;
  for (const auto& t : m.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f u = unit(minus(m.vertices_mm[t[(k + 1) % 3]], m.vertices_mm[t[k]]));
      const Vec3f v = unit(minus(m.vertices_mm[t[(k + 2) % 3]], m.vertices_mm[t[k]]));
      const double cosine = static_cast<double>(u.x) * static_cast<double>(v.x) +
                            static_cast<double>(u.y) * static_cast<double>(v.y) +
                            static_cast<double>(u.z) * static_cast<double>(v.z);
      smallest = std::min(smallest, std::acos(std::clamp(cosine, -1.0, 1.0)) * 57.29577951308232);
    }
  return smallest;
}

// Closed chains of boundary edges: 1 is a disc, each more a hole.
inline std::size_t boundary_loops(const FaceMesh& m) {
  std::set<Edge> edges;
  for (const auto& t : m.triangles)
    for (std::size_t k = 0; k < 3; ++k) edges.insert({t[k], t[(k + 1) % 3]});
  std::map<std::uint32_t, std::uint32_t> next;
  for (const Edge& e : edges)
    if (!edges.count({e.second, e.first})) next[e.first] = e.second;
  std::size_t loops = 0;
  while (!next.empty()) {
    ++loops;
    std::uint32_t v = next.begin()->first;
    while (next.count(v)) {
      const std::uint32_t to = next[v];
      next.erase(v);
      v = to;
    }
  }
  return loops;
}

}  // namespace relievo::pipeline

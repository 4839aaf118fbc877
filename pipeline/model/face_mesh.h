// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FaceMesh: a surface of triangles in the left camera's frame, millimetres. Triangles are
// counter-clockwise seen from outside; normals point out of the face, unit length.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

using Triangle = std::array<std::uint32_t, 3>;  // the numbers of its vertices

struct FaceMesh {
  explicit FaceMesh(std::pmr::memory_resource* memory)
      : vertices_mm(memory),
        normals(memory),
        sigma_mm(memory),
        measured(memory),
        pose(memory),
        triangles(memory) {}
  std::pmr::vector<Vec3f> vertices_mm;
  std::pmr::vector<Vec3f> normals;          // one a vertex
  std::pmr::vector<float> sigma_mm;         // one a vertex: standard deviation perpendicular to the surface
  std::pmr::vector<std::uint8_t> measured;  // one a vertex: 1 seen by both cameras, 0 completed
  std::pmr::vector<std::uint8_t> pose;      // one a vertex: the pair that measured it; empty: there was one
  std::pmr::vector<Triangle> triangles;
};

// Whether all three corners are marked, one mark a vertex.
inline bool all_three(std::span<const std::uint8_t> marks, const Triangle& t) {
  return marks[t[0]] != 0 && marks[t[1]] != 0 && marks[t[2]] != 0;
}

// Its border, one a vertex: 1 where the triangles around it do not close. Of a manifold surface. Throws
// std::bad_alloc.
inline std::pmr::vector<std::uint8_t> border_vertices(const FaceMesh& mesh,
                                                      std::pmr::memory_resource* memory) {
  std::pmr::vector<std::int64_t> turn(mesh.vertices_mm.size(), 0, memory);  // where they close it sums to 0
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      turn[t[i]] += std::int64_t{t[(i + 1) % 3]} - std::int64_t{t[(i + 2) % 3]};
  std::pmr::vector<std::uint8_t> border(turn.size(), 0, memory);
  for (std::size_t v = 0; v < turn.size(); ++v) border[v] = turn[v] != 0 ? 1 : 0;
  return border;
}

}  // namespace relievo::pipeline

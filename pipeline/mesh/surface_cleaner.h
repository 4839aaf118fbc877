// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every mesher does last: makes one clean surface of a heap of triangles, and gives it normals.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "hal/base/groups.h"
#include "hal/base/result.h"
#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {

using BorderEdge = std::array<std::uint32_t, 2>;  // as its triangle runs

// Out of a triangle as it winds; as long as twice its area.
inline Vec3f area_normal(std::span<const Vec3f> vertices_mm, const Triangle& t) {
  return cross(minus(vertices_mm[t[1]], vertices_mm[t[0]]), minus(vertices_mm[t[2]], vertices_mm[t[0]]));
}

// Which triangles lie around each vertex. Throws std::bad_alloc.
inline void group_around(Groups& around, std::size_t vertices, std::span<const Triangle> triangles) {
  around.sort(vertices, [triangles](auto&& add) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
      for (const std::uint32_t v : triangles[t]) add(v, t);
  });
}

// As the triangles run, sorted. Throws std::bad_alloc.
std::pmr::vector<BorderEdge> directed_edges(std::span<const Triangle> triangles,
                                            std::pmr::memory_resource* memory);

// Edges of one triangle alone, by their lower, then by their higher vertex. Throws std::bad_alloc.
std::pmr::vector<BorderEdge> border_edges(std::span<const Triangle> triangles,
                                          std::pmr::memory_resource* memory);

struct CleanerOptions {
  int ear_passes = 2;  // how often triangles that hang on by one edge are taken off the boundary
};

// Keeps the largest component (by area) that is joined through edges, drops all fans but the largest
// at a vertex where several meet, and trims the boundary. `triangles` must be consistently oriented
// with no edge used twice in the same direction. Shrinks `triangles`; its order stays.
// Throws std::bad_alloc when `scratch` is used up.
void keep_one_surface(std::span<const Vec3f> vertices_mm, std::pmr::vector<Triangle>& triangles,
                      const CleanerOptions& options, std::pmr::memory_resource* scratch);

// Area-weighted vertex normals (out of the face, as the triangles wind), then averaged `passes`
// times over each vertex's triangles.
void compute_normals(FaceMesh& mesh, int passes, std::pmr::memory_resource* scratch);

// sigma_mm holds sigmas along the line of sight from the left camera; turns them perpendicular.
void turn_sigma_perpendicular(FaceMesh& mesh);

// A vertex as it goes into the finished mesh.
struct PackedVertex {
  Vec3f at_mm;
  float sigma_mm = 0;
  std::uint8_t measured = 0;
  Vec3f normal{};  // pack_mesh() alone takes it; compute_normals() sets it
};

// Without a normal. Returns its number.
inline std::uint32_t add_vertex(FaceMesh& mesh, const PackedVertex& vertex) {
  mesh.vertices_mm.push_back(vertex.at_mm);
  mesh.sigma_mm.push_back(vertex.sigma_mm);
  mesh.measured.push_back(vertex.measured);
  return std::uint32_t(mesh.vertices_mm.size() - 1);
}

// The mesh, in `context.output`, of those of `count` vertices that a triangle uses, in their order;
// `vertex(v)` says what the v-th is. Throws std::bad_alloc when memory is used up.
template <typename Vertex>
FaceMesh pack_mesh(std::size_t count, std::span<const Triangle> triangles, StageContext& context,
                   Vertex&& vertex) {
  constexpr std::uint32_t kUnused = 0xFFFFFFFFU;
  std::pmr::vector<std::uint32_t> place(count, kUnused, &context.scratch);
  std::uint32_t used = 0;
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) place[v] = 0;
  for (std::uint32_t& p : place)
    if (p != kUnused) p = used++;
  FaceMesh mesh(&context.output);
  mesh.vertices_mm.reserve(used);
  mesh.normals.reserve(used);
  mesh.sigma_mm.reserve(used);
  mesh.measured.reserve(used);
  mesh.triangles.reserve(triangles.size());
  for (std::size_t v = 0; v < count; ++v)
    if (place[v] != kUnused) {
      const PackedVertex packed = vertex(v);
      add_vertex(mesh, packed);
      mesh.normals.push_back(packed.normal);
    }
  for (const Triangle& t : triangles) mesh.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
  return mesh;
}

// What every mesher says of points that are no face.
Error no_surface();

double area_mm2(std::span<const Vec3f> vertices_mm, std::span<const Triangle> triangles);

}  // namespace relievo::pipeline

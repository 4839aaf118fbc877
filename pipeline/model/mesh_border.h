// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The border of a surface of triangles. Thread: any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "pipeline/model/face_mesh.h"

namespace relievo::pipeline {

// One a vertex: 1 where the triangles around it do not close. Of a manifold surface. Throws std::bad_alloc.
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

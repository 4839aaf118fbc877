// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Corners that share vertex and texture coordinate share one entry: vertices are split at the seams of the
// texture and nowhere else. Thread: any. Memory: the caller's. Errors: none; indices must be in range.
#pragma once

#include <bit>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/model/face_mesh.h"

namespace relievo::pipeline {

struct SeamSplit {
  struct Entry {
    std::uint32_t vertex = 0;
    Vec2f uv;
  };
  std::pmr::vector<Entry> entries;       // in order of first use
  std::pmr::vector<Triangle> triangles;  // of entries, in the mesh's order
};

// `uv`: three a triangle; where there are none they are zero, so that entries are the vertices in use.
inline SeamSplit split_at_seams(const FaceMesh& mesh, std::span<const Vec2f> uv,
                                std::pmr::memory_resource* memory = std::pmr::get_default_resource()) {
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  const auto& triangles = mesh.triangles;
  const std::size_t vertices = mesh.vertices_mm.size();
  SeamSplit split{std::pmr::vector<SeamSplit::Entry>(memory),
                  std::pmr::vector<Triangle>(triangles.size(), memory)};
  split.entries.reserve(vertices);
  // A vertex has few charts around it: a list per vertex, linked through the entries.
  std::pmr::vector<std::uint32_t> first(vertices, kNone, memory), next(memory);
  next.reserve(vertices);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = triangles[t][k];
      const Vec2f at = uv.empty() ? Vec2f{} : uv[3 * t + k];
      std::uint32_t entry = first[vertex];
      while (entry != kNone &&
             std::bit_cast<std::uint64_t>(split.entries[entry].uv) != std::bit_cast<std::uint64_t>(at))
        entry = next[entry];
      if (entry == kNone) {
        entry = std::uint32_t(split.entries.size());
        split.entries.push_back({vertex, at});
        next.push_back(first[vertex]);
        first[vertex] = entry;
      }
      split.triangles[t][k] = entry;
    }
  return split;
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/export/format/seam_split.h"

#include <bit>

namespace relievo::storage {

SeamSplit split_at_seams(const ExportMesh& mesh) {
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  const auto& triangles = mesh.model.mesh.triangles;
  const auto& uvs = mesh.model.texture.uv;
  SeamSplit split;
  split.triangles.reserve(triangles.size());
  split.entries.reserve(mesh.vertices_mm.size());
  // A vertex has few charts around it: a list per vertex, linked through the entries.
  std::vector<std::uint32_t> first(mesh.vertices_mm.size(), kNone);
  std::vector<std::uint32_t> next;
  next.reserve(mesh.vertices_mm.size());

  for (std::size_t t = 0; t < triangles.size(); ++t) {
    auto& target = split.triangles.emplace_back();
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t vertex = triangles[t][c];
      const pipeline::Vec2f uv = mesh.textured() ? uvs[3 * t + c] : pipeline::Vec2f{};
      std::uint32_t entry = first[vertex];
      while (entry != kNone &&
             !(std::bit_cast<std::uint64_t>(split.entries[entry].uv) == std::bit_cast<std::uint64_t>(uv))) {
        entry = next[entry];
      }
      if (entry == kNone) {
        entry = static_cast<std::uint32_t>(split.entries.size());
        split.entries.push_back({vertex, uv});
        next.push_back(first[vertex]);
        first[vertex] = entry;
      }
      target[c] = entry;
    }
  }
  return split;
}

}  // namespace relievo::storage

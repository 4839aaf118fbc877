// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Corners that share vertex and texture coordinate share one entry: vertices are split at the seams
// of the texture and nowhere else.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pipeline/model/geometry.h"
#include "storage/export/format/export_mesh.h"

namespace relievo::storage {

struct SeamSplit {
  struct Entry {
    std::uint32_t vertex = 0;
    pipeline::Vec2f uv;
  };
  std::vector<Entry> entries;                           // in order of first use
  std::vector<std::array<std::uint32_t, 3>> triangles;  // of entries, in the mesh's order
};

// For an untextured mesh uv are zero, so that entries are the vertices in use.
SeamSplit split_at_seams(const ExportMesh& mesh);

}  // namespace relievo::storage

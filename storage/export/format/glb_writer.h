// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// model.glb: glTF 2.0 in one file, textured, with normals. Metres, y up, the face looks along +z:
// glTF fixes these, so a mesh in the camera frame is turned half way round x (its origin stays the
// left camera). _SIGMA_MM and _MEASURED travel along as attributes of a vertex.
// May throw std::bad_alloc. Thread: any.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "storage/export/format/export_mesh.h"

namespace relievo::storage {

// `png` is the mesh's texture; empty if it has none, then the vertices are coloured.
std::vector<std::byte> glb_bytes(const ExportMesh& mesh, std::span<const std::byte> png);

}  // namespace relievo::storage

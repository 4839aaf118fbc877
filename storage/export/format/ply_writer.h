// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// model.ply: binary little-endian; a vertex is float32 x y z nx ny nz sigma_mm, uchar red green blue
// measured; a face is a list of three. Millimetres, in the mesh's frame.
// May throw std::bad_alloc. Thread: any.
#pragma once

#include <cstddef>
#include <vector>

#include "storage/export/format/export_mesh.h"

namespace relievo::storage {

std::vector<std::byte> ply_bytes(const ExportMesh& mesh);

}  // namespace relievo::storage

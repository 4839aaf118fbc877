// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// model.stl: binary STL, for printing and for programs that read nothing else. Millimetres, in the
// mesh's frame; a triangle's normal is its own. May throw std::bad_alloc. Thread: any.
#pragma once

#include <cstddef>
#include <vector>

#include "storage/export/format/export_mesh.h"

namespace relievo::storage {

std::vector<std::byte> stl_bytes(const ExportMesh& mesh);

}  // namespace relievo::storage

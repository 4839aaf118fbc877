// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wavefront OBJ with its material. Millimetres, in the mesh's frame; texture coordinates from the
// lower left, as the format wants. Rounded to a thousandth of a millimetre. One smoothing group instead of
// normals: a reader works them out of so fine a mesh, and the file is a third smaller (GLB and PLY carry
// ours). May throw std::bad_alloc. Thread: any.
#pragma once

#include <string>
#include <string_view>

#include "storage/export/format/export_mesh.h"

namespace relievo::storage {

std::string obj_text(const ExportMesh& mesh, std::string_view mtl_name);
std::string mtl_text(const ExportMesh& mesh, std::string_view png_name);

}  // namespace relievo::storage

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bytes of a model's files. May throw std::bad_alloc. Thread: any.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/export/format/export_mesh.h"

namespace relievo::storage {

// model.stl: binary STL, for printing and for programs that read nothing else. Millimetres, in the
// mesh's frame; a triangle's normal is its own.
std::vector<std::byte> stl_bytes(const ExportMesh& mesh);

// model.ply: binary little-endian; a vertex is float32 x y z nx ny nz sigma_mm, uchar red green blue
// measured; a face is a list of three. Millimetres, in the mesh's frame.
std::vector<std::byte> ply_bytes(const ExportMesh& mesh);

// model.obj: Wavefront OBJ with its material. Millimetres, in the mesh's frame; texture coordinates from the
// lower left, as the format wants. Rounded to a thousandth of a millimetre. One smoothing group instead of
// normals: a reader works them out of so fine a mesh, and the file is a third smaller (GLB and PLY carry
// ours).
std::string obj_text(const ExportMesh& mesh, std::string_view mtl_name);
std::string mtl_text(const ExportMesh& mesh, std::string_view png_name);

// model.glb: glTF 2.0 in one file, textured, with normals. Metres, y up, the face looks along +z:
// glTF fixes these, so a mesh in the camera frame is turned half way round x (its origin stays the
// left camera). _SIGMA_MM and _MEASURED travel along as attributes of a vertex.
// `png` is the mesh's texture; empty if it has none, then the vertices are coloured.
std::vector<std::byte> glb_bytes(const ExportMesh& mesh, std::span<const std::byte> png);

}  // namespace relievo::storage

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/export/format/obj_writer.h"

#include "storage/export/format/number_text.h"
#include "storage/export/format/seam_split.h"

namespace relievo::storage {
namespace {

// What the file is good for and no more: a thousandth of a millimetre, a fiftieth of a texel of the largest
// atlas.
constexpr int kPlaceDecimals = 3, kTextureDecimals = 5;

template <typename... Numbers>
void add_line(std::string& text, const char* word, int decimals, Numbers... values) {
  text += word;
  ((text += ' ', append_rounded(text, static_cast<double>(values), decimals)), ...);
  text += '\n';
}

}  // namespace

std::string obj_text(const ExportMesh& mesh, std::string_view mtl_name) {
  const SeamSplit split = split_at_seams(mesh);
  std::string text;
  text.reserve(256 + mesh.vertices_mm.size() * 29 + split.entries.size() * 20 + split.triangles.size() * 46);
  text += "# Relievo face model, millimetres, ";
  text += mesh.frame == ExportFrame::Head ? "head frame: x to the person's left, y up, z out of the face\n"
                                          : "camera frame: x right, y down, z forward\n";
  text.append("mtllib ").append(mtl_name).append("\no face\n");
  for (const auto& v : mesh.vertices_mm) add_line(text, "v", kPlaceDecimals, v.x, v.y, v.z);
  if (mesh.textured()) {
    for (const auto& entry : split.entries)
      add_line(text, "vt", kTextureDecimals, entry.uv.x, 1.0f - entry.uv.y);
  }
  text += "usemtl face\ns 1\n";
  for (const auto& triangle : split.triangles) {
    text += 'f';
    for (const std::uint32_t entry : triangle) {
      const std::uint32_t vertex = split.entries[entry].vertex + 1;
      text += ' ';
      append_number(text, vertex);
      if (!mesh.textured()) continue;
      text += '/';
      append_number(text, entry + 1);
    }
    text += '\n';
  }
  return text;
}

std::string mtl_text(const ExportMesh& mesh, std::string_view png_name) {
  std::string text = "# Relievo face model\nnewmtl face\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\n";
  if (mesh.textured()) text.append("map_Kd ").append(png_name).append("\n");
  return text;
}

}  // namespace relievo::storage

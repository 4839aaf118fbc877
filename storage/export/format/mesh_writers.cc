// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "pipeline/model/seam_split.h"
#include "pipeline/model/vector3.h"
#include "storage/byte_order.h"
#include "storage/export/format/export_mesh.h"

namespace relievo::storage {
namespace {

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kStlFaceBytes = 12 * 4 + 2;

pipeline::Vec3f normal_of(const pipeline::Vec3f& a, const pipeline::Vec3f& b, const pipeline::Vec3f& c) {
  const pipeline::Vec3f n = cross(minus(b, a), minus(c, a));
  const float length = std::hypot(n.x, n.y, n.z);
  if (!(length > 0)) return {};  // the format's word for "work it out yourself"
  return {n.x / length, n.y / length, n.z / length};
}

constexpr std::size_t kVertexBytes = 7 * 4 + 4;
constexpr std::size_t kPlyFaceBytes = 1 + 3 * 4;

std::string header(const ExportMesh& mesh) {
  const bool head = mesh.frame == ExportFrame::Head;
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment Relievo face model, millimetres\n";
  text += head ? "comment frame head: origin at the tip of the nose, x to the person's left, y up, z out of "
                 "the face\n"
               : "comment frame camera: the left camera, x right, y down, z forward\n";
  for (const PlacedLandmark& l : placed_landmarks(mesh)) {
    text += "comment landmark " + std::string(l.name);
    for (const double value : {l.at_mm.x, l.at_mm.y, l.at_mm.z, l.sigma_mm}) {
      text += " ";
      append_rounded(text, value, 3);
    }
    text += "\n";
  }
  text += "element vertex " + std::to_string(mesh.vertices_mm.size()) + "\n";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "sigma_mm"})
    text += std::string("property float ") + name + "\n";
  for (const char* name : {"red", "green", "blue", "measured"})
    text += std::string("property uchar ") + name + "\n";
  if (!mesh.model.mesh.pose.empty()) text += "property uchar pose\n";
  text += "element face " + std::to_string(mesh.model.mesh.triangles.size()) + "\n";
  return text + "property list uchar int vertex_indices\nend_header\n";
}

// What the file is good for and no more: a thousandth of a millimetre, a fiftieth of a texel of the largest
// atlas.
constexpr int kPlaceDecimals = 3, kTextureDecimals = 5;

template <typename... Numbers>
void add_line(std::string& text, const char* word, int decimals, Numbers... values) {
  text += word;
  ((text += ' ', append_rounded(text, double(values), decimals)), ...);
  text += '\n';
}

}  // namespace

std::vector<std::byte> stl_bytes(const ExportMesh& mesh) {
  const auto& triangles = mesh.model.mesh.triangles;
  std::vector<std::byte> out;
  out.reserve(kHeaderBytes + 4 + triangles.size() * kStlFaceBytes);
  ByteWriter to(out);
  std::string header =
      "Relievo face model, binary, millimetres";  // must not begin with "solid": that is the text form
  header.resize(kHeaderBytes, ' ');
  to.put(bytes_of(header));
  to.put(std::uint32_t(triangles.size()));
  for (const auto& t : triangles) {
    const auto &a = mesh.vertices_mm[t[0]], &b = mesh.vertices_mm[t[1]], &c = mesh.vertices_mm[t[2]];
    for (const auto& v : {normal_of(a, b, c), a, b, c})
      for (const float value : {v.x, v.y, v.z}) to.put(value);
    to.put(std::uint16_t{0});
  }
  return out;
}

std::vector<std::byte> ply_bytes(const ExportMesh& mesh) {
  const auto& source = mesh.model.mesh;
  const std::string text = header(mesh);
  std::vector<std::byte> out;
  out.reserve(text.size() + mesh.vertices_mm.size() * kVertexBytes + source.triangles.size() * kPlyFaceBytes);
  ByteWriter to(out);
  to.put(bytes_of(text));
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    const auto& at = mesh.vertices_mm[i];
    const auto& normal = mesh.normals[i];
    const float sigma_mm = source.sigma_mm.empty() ? 0.0f : source.sigma_mm[i];
    for (const float value : {at.x, at.y, at.z, normal.x, normal.y, normal.z, sigma_mm}) to.put(value);
    for (const std::uint8_t value : mesh.colours[i]) to.put(value);
    to.put(source.measured.empty() ? std::uint8_t{0} : source.measured[i]);
    if (!source.pose.empty()) to.put(source.pose[i]);
  }
  for (const auto& triangle : source.triangles) {
    to.put(std::uint8_t{3});
    for (const std::uint32_t i : triangle) to.put(i);
  }
  return out;
}

std::string obj_text(const ExportMesh& mesh, std::string_view mtl_name) {
  const pipeline::SeamSplit split = pipeline::split_at_seams(mesh.model.mesh, mesh.model.texture.uv);
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

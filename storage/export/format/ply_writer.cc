// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/export/format/ply_writer.h"

#include <string>

#include "storage/byte_order.h"
#include "storage/export/format/number_text.h"
#include "storage/export/format/placed_landmarks.h"

namespace relievo::storage {
namespace {

constexpr std::size_t kVertexBytes = 7 * 4 + 4;
constexpr std::size_t kFaceBytes = 1 + 3 * 4;

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

}  // namespace

std::vector<std::byte> ply_bytes(const ExportMesh& mesh) {
  const auto& source = mesh.model.mesh;
  const std::string text = header(mesh);
  std::vector<std::byte> out;
  out.reserve(text.size() + mesh.vertices_mm.size() * kVertexBytes + source.triangles.size() * kFaceBytes);
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

}  // namespace relievo::storage

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/export/format/stl_writer.h"

#include <cmath>
#include <string>

#include "storage/byte_order.h"

namespace relievo::storage {
namespace {

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kFaceBytes = 12 * 4 + 2;

pipeline::Vec3f normal_of(const pipeline::Vec3f& a, const pipeline::Vec3f& b, const pipeline::Vec3f& c) {
  const pipeline::Vec3f u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z};
  const pipeline::Vec3f n{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
  const float length = std::hypot(n.x, n.y, n.z);
  if (!(length > 0)) return {};  // the format's word for "work it out yourself"
  return {n.x / length, n.y / length, n.z / length};
}

}  // namespace

std::vector<std::byte> stl_bytes(const ExportMesh& mesh) {
  const auto& triangles = mesh.model.mesh.triangles;
  std::vector<std::byte> out;
  out.reserve(kHeaderBytes + 4 + triangles.size() * kFaceBytes);
  ByteWriter to(out);
  std::string header =
      "Relievo face model, binary, millimetres";  // must not begin with "solid": that is the text form
  header.resize(kHeaderBytes, ' ');
  to.put(bytes_of(header));
  to.put(static_cast<std::uint32_t>(triangles.size()));
  for (const auto& t : triangles) {
    const auto &a = mesh.vertices_mm[t[0]], &b = mesh.vertices_mm[t[1]], &c = mesh.vertices_mm[t[2]];
    for (const auto& v : {normal_of(a, b, c), a, b, c})
      for (const float value : {v.x, v.y, v.z}) to.put(value);
    to.put(std::uint16_t{0});
  }
  return out;
}

}  // namespace relievo::storage

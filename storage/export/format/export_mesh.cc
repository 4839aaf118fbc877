// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/export/format/export_mesh.h"

#include <algorithm>

#include "pipeline/model/vector3.h"
#include "storage/model_blob.h"

namespace relievo::storage {
namespace {

using pipeline::FaceModel;
using pipeline::Vec3d;
using pipeline::Vec3f;

using pipeline::narrow;
using pipeline::wide;
bool finite(const Vec3f& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Lengths and numbers; what a writer below relies on.
Result<void> check(const FaceModel& model) {
  const auto& mesh = model.mesh;
  const auto& texture = model.texture;
  if (mesh.triangles.empty()) return invalid("the model has no surface to write");
  if (mesh.vertices_mm.size() > 0x7fffffff || (texture.rgb.empty() && !texture.uv.empty()))
    return invalid("the model's arrays do not fit together");
  RELIEVO_TRY(check_arrays(model));
  if (!std::ranges::all_of(mesh.vertices_mm, finite) || !std::ranges::all_of(texture.uv, [](const auto& uv) {
        return std::isfinite(uv.x) && std::isfinite(uv.y);
      })) {
    return invalid("the model has vertices that are nowhere");
  }
  return {};
}

// Area-weighted, for models that come without.
std::vector<Vec3d> normals_of(const pipeline::FaceMesh& mesh) {
  std::vector<Vec3d> normals(mesh.vertices_mm.size());
  if (!mesh.normals.empty()) {
    std::ranges::transform(mesh.normals, normals.begin(), wide);
    return normals;
  }
  for (const auto& t : mesh.triangles) {
    const Vec3d a = wide(mesh.vertices_mm[t[0]]), b = wide(mesh.vertices_mm[t[1]]),
                c = wide(mesh.vertices_mm[t[2]]);
    const Vec3d n = cross(minus(b, a), minus(c, a));
    for (const std::uint32_t i : t) normals[i] = plus(normals[i], n);
  }
  return normals;
}

// Unit length even where there is no direction: readers refuse a normal of zero.
Vec3f unit(const Vec3d& v, const Vec3d& otherwise) {
  const double length = std::hypot(v.x, v.y, v.z);
  if (!std::isfinite(length) || length < 1e-12) return narrow(otherwise);
  return narrow({v.x / length, v.y / length, v.z / length});
}

}  // namespace

Result<ExportMesh> make_export_mesh(const FaceModel& model, ExportFrame frame) {
  RELIEVO_TRY(check(model));
  const bool head = frame == ExportFrame::Head;
  const Vec3d out_of_the_face{0, 0, head ? 1.0 : -1.0};
  const std::size_t count = model.mesh.vertices_mm.size();
  ExportMesh mesh{model, frame, {}, {}, {}, {}};
  mesh.vertices_mm.reserve(count);
  mesh.normals.reserve(count);
  mesh.colours.reserve(count);
  const auto normals = normals_of(model.mesh);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3f& at = model.mesh.vertices_mm[i];
    mesh.vertices_mm.push_back(head ? narrow(apply(model.head_from_camera, wide(at))) : at);
    mesh.normals.push_back(
        unit(head ? apply(model.head_from_camera.rotation, normals[i]) : normals[i], out_of_the_face));
    const std::uint8_t* rgb =
        model.texture.vertex_rgb.empty() ? nullptr : model.texture.vertex_rgb.data() + 3 * i;
    mesh.colours.push_back(rgb == nullptr ? std::array<std::uint8_t, 3>{255, 255, 255}
                                          : std::array<std::uint8_t, 3>{rgb[0], rgb[1], rgb[2]});
  }
  if (!std::ranges::all_of(mesh.vertices_mm, finite)) {
    return invalid("the model's head frame cannot be right");
  }
  return mesh;
}

}  // namespace relievo::storage

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/render/face_geometry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory_resource>

#include "pipeline/model/mesh_border.h"

namespace relievo::ui {
namespace {

constexpr float kMiddleBehindMm = 45;  // the head turns about a point behind the tip of its nose
constexpr float kFadeMm = 6;           // of the rim, into what stands behind

// How far from its border each vertex lies, in kFadeMm and no more than 1.
std::vector<float> within(const pipeline::FaceMesh& mesh) {
  const auto border = pipeline::border_vertices(mesh, std::pmr::get_default_resource());
  std::vector<float> share(border.size(), 1.0F);
  for (std::size_t v = 0; v < border.size(); ++v)
    if (border[v] != 0) share[v] = 0;
  const auto spread = [&](const std::array<std::uint32_t, 3>& t) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 1; j < 3; ++j) {
        const auto &a = mesh.vertices_mm[t[i]], &b = mesh.vertices_mm[t[(i + j) % 3]];
        if (share[t[i]] >= 1) continue;
        share[t[(i + j) % 3]] = std::min(share[t[(i + j) % 3]],
                                         share[t[i]] + std::hypot(a.x - b.x, a.y - b.y, a.z - b.z) / kFadeMm);
      }
  };
  for (int pass = 0; pass < 2; ++pass) {
    std::for_each(mesh.triangles.begin(), mesh.triangles.end(), spread);
    std::for_each(mesh.triangles.rbegin(), mesh.triangles.rend(), spread);
  }
  return share;
}

}  // namespace

Dot dot_of(const pipeline::RigidTransform& t, const pipeline::Vec3f& v) {
  const auto p = apply(t, pipeline::Vec3d{v.x, v.y, v.z});
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z) + kMiddleBehindMm};
}

std::vector<Dot> dots_of(const pipeline::FaceModel& model, const pipeline::PointCloud* cloud) {
  std::vector<Dot> dots;
  if (cloud == nullptr)
    for (const auto& v : model.mesh.vertices_mm) dots.push_back(dot_of(model.head_from_camera, v));
  else
    for (const auto& p : cloud->points) dots.push_back(dot_of(model.head_from_camera, p.at_mm));
  return dots;
}

std::vector<Tinted> tinted_of(const pipeline::FaceModel& model) {
  const pipeline::Backdrop& b = model.backdrop;
  std::vector<Tinted> corners;
  const auto corner = [&](int c, int r) {
    const std::size_t k =
        static_cast<std::size_t>(r) * static_cast<std::size_t>(b.columns) + static_cast<std::size_t>(c);
    const Dot d = dot_of(model.head_from_camera, b.at_mm[k]);
    return Tinted{d.x, d.y, d.z, b.rgba[k]};
  };
  for (int r = 0; r + 1 < b.rows; ++r)
    for (int c = 0; c + 1 < b.columns; ++c) {
      const Tinted p = corner(c, r), q = corner(c + 1, r), o = corner(c, r + 1), d = corner(c + 1, r + 1);
      if ((p.rgba[3] | q.rgba[3] | o.rgba[3] | d.rgba[3]) != 0)
        corners.insert(corners.end(), {p, o, d, p, d, q});
    }
  return corners;
}

std::vector<Corner> corners_of(const pipeline::FaceModel& model, const pipeline::TextureAtlas& texture) {
  const auto& t = model.head_from_camera;
  const std::vector<float> share = within(model.mesh);
  std::vector<Corner> corners;
  corners.reserve(model.mesh.triangles.size() * 3);
  for (std::size_t i = 0; i < model.mesh.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t at = model.mesh.triangles[i][k];
      const auto& v = model.mesh.vertices_mm[at];
      const auto& n = model.mesh.normals[at];
      const Dot p = dot_of(t, v);
      const auto m = apply(t.rotation, pipeline::Vec3d{n.x, n.y, n.z});
      const bool flat = texture.uv.size() <= 3 * i + k;
      const pipeline::Vec2f uv = flat ? pipeline::Vec2f{} : texture.uv[3 * i + k];
      corners.push_back({p.x, p.y, p.z, static_cast<float>(m.x), static_cast<float>(m.y),
                         static_cast<float>(m.z), uv.x, uv.y, share[at]});
    }
  }
  return corners;
}

}  // namespace relievo::ui

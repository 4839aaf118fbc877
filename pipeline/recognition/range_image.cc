// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/recognition/range_image.h"

#include <cmath>

#include "pipeline/texture/chart/raster.h"

namespace relievo::pipeline {
namespace {

constexpr float kLeastFacing = 0.0872F;  // cosine of 85 degrees

struct HeadPoint {
  Vec2f pixel;
  float z_mm;
};

std::pmr::vector<HeadPoint> on_the_grid(const FaceMesh& mesh, const RigidTransform& head_from_camera,
                                        const RangeGrid& grid, std::pmr::memory_resource* memory) {
  std::pmr::vector<HeadPoint> points(memory);
  points.reserve(mesh.vertices_mm.size());
  for (const Vec3f& v : mesh.vertices_mm) {
    const Vec3d p = apply(head_from_camera, Vec3d{static_cast<double>(v.x), static_cast<double>(v.y),
                                                  static_cast<double>(v.z)});
    points.push_back({{static_cast<float>((p.x - grid.first_mm.x) / grid.pitch_mm),
                       static_cast<float>((grid.first_mm.y - p.y) / grid.pitch_mm)},
                      static_cast<float>(p.z)});
  }
  return points;
}

// Cosine between a triangle's normal and +z; negative from behind. Rows run downwards, hence the sign.
float facing(const HeadPoint& a, const HeadPoint& b, const HeadPoint& c, float pitch) {
  const float ux = (b.pixel.x - a.pixel.x) * pitch, uy = -(b.pixel.y - a.pixel.y) * pitch,
              uz = b.z_mm - a.z_mm;
  const float vx = (c.pixel.x - a.pixel.x) * pitch, vy = -(c.pixel.y - a.pixel.y) * pitch,
              vz = c.z_mm - a.z_mm;
  const float nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
  const float length = std::sqrt(nx * nx + ny * ny + nz * nz);
  return length > 0 ? nz / length : 0;
}

}  // namespace

RangeImage measure_range(const FaceMesh& mesh, const RigidTransform& head_from_camera, const RangeGrid& grid,
                         std::pmr::memory_resource* output, std::pmr::memory_resource* scratch) {
  RangeImage image(output);
  image.width_px = grid.width_px;
  image.height_px = grid.height_px;
  image.pitch_mm = grid.pitch_mm;
  image.first_mm = grid.first_mm;
  const std::size_t size = static_cast<std::size_t>(grid.width_px) * static_cast<std::size_t>(grid.height_px);
  image.z_mm.assign(size, 0);
  image.sigma_mm.assign(size, 0);
  image.shows.assign(size, kNothingShown);
  const auto points = on_the_grid(mesh, head_from_camera, grid, scratch);
  const auto sigma = [&](std::uint32_t v) { return mesh.sigma_mm.empty() ? 0.0F : mesh.sigma_mm[v]; };
  const auto measured = [&](std::uint32_t v) { return mesh.measured.empty() || mesh.measured[v] != 0; };
  for (const auto& t : mesh.triangles) {
    const HeadPoint& a = points[t[0]];
    const HeadPoint& b = points[t[1]];
    const HeadPoint& c = points[t[2]];
    const float cosine = facing(a, b, c, static_cast<float>(grid.pitch_mm));
    if (cosine < kLeastFacing) continue;
    const std::uint8_t shows =
        measured(t[0]) && measured(t[1]) && measured(t[2]) ? kMeasuredShown : kCompletedShown;
    for_each_texel(a.pixel, b.pixel, c.pixel, grid.width_px, {0, grid.height_px},
                   [&](int x, int y, float wa, float wb, float wc) {
                     const std::size_t k =
                         static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width_px) +
                         static_cast<std::size_t>(x);
                     const float z = wa * a.z_mm + wb * b.z_mm + wc * c.z_mm;
                     if (image.shows[k] != kNothingShown && z <= image.z_mm[k]) return;
                     image.z_mm[k] = z;
                     // The mesh knows its deviation across the surface; along z a slope makes it longer.
                     image.sigma_mm[k] = (wa * sigma(t[0]) + wb * sigma(t[1]) + wc * sigma(t[2])) / cosine;
                     image.shows[k] = shows;
                   });
  }
  return image;
}

}  // namespace relievo::pipeline

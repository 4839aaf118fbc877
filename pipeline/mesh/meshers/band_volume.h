// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// BandVolume: a box of voxels around a surface, with a value at those within a narrow band of it: what
// marching cubes walks over, whoever makes the values. Positive outside. Millimetres.
//
// polygonise(): the surface where the values pass through zero (marching cubes; Lorensen, Cline 1987), with
// its ambiguous faces decided by the asymptotic decider (Nielson, Hamann 1991): the crossings of each face
// are joined by the sign of its bilinear saddle, the same for both cells that share it, and followed around
// the cell to closed loops. So there is no table, and no crack: every edge within the band has two triangles.
#pragma once

#include <cstddef>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/base/stage.h"
#include "pipeline/mesh/surface_cleaner.h"

namespace relievo::pipeline {

struct BandVolume {
  explicit BandVolume(std::pmr::memory_resource* memory) : value(memory) {}
  int nx = 0, ny = 0, nz = 0;
  float voxel_mm = 1;
  Vec3f corner_mm;                // of voxel (0, 0, 0)
  std::pmr::vector<float> value;  // x fastest; NaN outside the band

  std::size_t index(int x, int y, int z) const {
    return (std::size_t(z) * std::size_t(ny) + std::size_t(y)) * std::size_t(nx) + std::size_t(x);
  }
  Vec3f at(int x, int y, int z) const {
    return {corner_mm.x + voxel_mm * float(x), corner_mm.y + voxel_mm * float(y),
            corner_mm.z + voxel_mm * float(z)};
  }
};

// A box around the points, `margin` voxels wider each way, all values NaN. Throws std::bad_alloc.
BandVolume volume_around(std::span<const Vec3f> points_mm, float voxel_mm, int margin,
                         std::pmr::memory_resource* memory);

// Calls visit(x, y, z) for all voxels within `radius_mm` of a point, once for each such point.
template <typename Visit>
void for_each_voxel_near(const BandVolume& volume, const Vec3f& p, float radius_mm, Visit&& visit) {
  const auto cell = [&](float at, float from) { return (at - from) / volume.voxel_mm; };
  const float x = cell(p.x, volume.corner_mm.x), y = cell(p.y, volume.corner_mm.y),
              z = cell(p.z, volume.corner_mm.z);
  const float r = radius_mm / volume.voxel_mm;
  for (int k = int(z - r) + 1; float(k) <= z + r; ++k)
    for (int j = int(y - r) + 1; float(j) <= y + r; ++j)
      for (int i = int(x - r) + 1; float(i) <= x + r; ++i) {
        const float dx = float(i) - x, dy = float(j) - y, dz = float(k) - z;
        if (dx * dx + dy * dy + dz * dz <= r * r) visit(i, j, k);
      }
}

// A point with the plane through it.
struct FieldPoint {
  Vec3f at_mm, normal;
  float weight;
};

// At each voxel within `radius_mm` of a point the mean of the distances to the points' planes, weighted by
// their weights and a Gaussian of a voxel (implicit moving least squares; Kolluri 2008), at most `radius_mm`;
// NaN elsewhere. Works on the pool; the result does not depend on its size. Memory: scratch, 4 bytes a voxel.
void fill_field(std::span<const FieldPoint> points, float radius_mm, BandVolume& volume,
                StageContext& context);

struct Polygonised {
  explicit Polygonised(std::pmr::memory_resource* memory) : vertices_mm(memory), triangles(memory) {}
  std::pmr::vector<Vec3f> vertices_mm;
  std::pmr::vector<Triangle> triangles;  // counter-clockwise seen from where the values are positive
};

// Cells with a corner outside the band carry nothing. Throws std::bad_alloc when `memory` is used up.
Polygonised polygonise(const BandVolume& volume, std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline

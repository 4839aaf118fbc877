// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every mesher does last: makes one clean surface of a heap of triangles, and gives it normals.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/model/face_mesh.h"

namespace relievo::pipeline {

using Triangle = std::array<std::uint32_t, 3>;

struct CleanerOptions {
  int ear_passes = 2;     // how often triangles that hang on by one edge are taken off the boundary
};

// Keeps the largest component (by area) that is joined through edges, drops all fans but the largest
// at a vertex where several meet, and trims the boundary. `triangles` must be consistently oriented
// with no edge used twice in the same direction. Shrinks `triangles`; its order stays.
// Throws std::bad_alloc when `scratch` is used up.
void keep_one_surface(std::span<const Vec3f> vertices_mm, std::pmr::vector<Triangle>& triangles,
                      const CleanerOptions& options, std::pmr::memory_resource* scratch);

// Area-weighted vertex normals (out of the face, as the triangles wind), then averaged `passes`
// times over each vertex's triangles.
void compute_normals(FaceMesh& mesh, int passes, std::pmr::memory_resource* scratch);

// sigma_mm holds sigmas along the line of sight from the left camera; turns them perpendicular.
void turn_sigma_perpendicular(FaceMesh& mesh);

double area_mm2(std::span<const Vec3f> vertices_mm, std::span<const Triangle> triangles);

}  // namespace relievo::pipeline

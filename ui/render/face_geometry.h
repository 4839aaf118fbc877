// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What of a model is handed to the graphics card, in the head frame, mm, with the point the head turns about
// as its origin. Thread: main. Errors: none.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pipeline/model/face_mesh.h"
#include "pipeline/model/face_model.h"
#include "pipeline/model/point_cloud.h"

namespace relievo::ui {

// Of a triangle; `within` is how far from the rim of the surface it lies, 0 to 1.
struct Corner {
  float x, y, z, nx, ny, nz, u, v, within;
};

struct Tinted {
  float x, y, z;
  std::array<std::uint8_t, 4> rgba;
};

struct Dot {
  float x, y, z;
};

// From the left camera's frame.
Dot dot_of(const pipeline::RigidTransform& head_from_camera, const pipeline::Vec3f& at_mm);
// Three for every triangle, in the mesh's order, with their places in the texture.
std::vector<Corner> corners_of(const pipeline::FaceModel& model, const pipeline::TextureAtlas& texture);
// The cloud, or where there is none the mesh's vertices.
std::vector<Dot> dots_of(const pipeline::FaceModel& model, const pipeline::PointCloud* cloud);
// The backdrop: two triangles a cell that shows anything.
std::vector<Tinted> tinted_of(const pipeline::FaceModel& model);

// The sides of a mesh's triangles, no finer than can be told apart: vertices about `least_mm` apart stand for
// those around them, and two are joined where their surroundings meet three by three (the dual of the Voronoi
// cells on the mesh). A mesh that is as coarse already keeps its own sides. Thread: any. Memory: the heap, in
// proportion to the mesh. Errors: none.

// Each once, two of the mesh's vertices.
using Edges = std::vector<std::array<std::uint32_t, 2>>;
Edges edges_of(const pipeline::FaceMesh& mesh, float least_mm);

}  // namespace relievo::ui

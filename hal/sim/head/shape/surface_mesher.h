// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Turns an implicit surface into triangles: surface nets (S. Gibson, 1998) on a grid that is only
// filled where the surface can be, then steps along the gradient onto the surface itself.
// Thread: one caller; works on all bands of the given pool.
#pragma once

#include <functional>

#include "hal/base/thread_pool.h"
#include "hal/sim/optics/ray_caster.h"

namespace relievo::hal::sim {

struct Box {
  Vec3 low, high;
};
using Field = std::function<double(Vec3)>;  // negative inside, mm near the surface

// Throws std::bad_alloc only.
Mesh mesh_of_field(const Field& field, const Box& box, double step_mm, ThreadPool& pool);

// Splits the edges whose two ends both satisfy `wanted` and puts the new points on the surface.
void refine(Mesh& mesh, const Field& field, const std::function<bool(Vec3)>& wanted, ThreadPool& pool);

std::vector<Vec3> smooth_normals(const Mesh& mesh);  // weighted by area

}  // namespace relievo::hal::sim

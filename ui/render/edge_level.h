// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sides of a mesh's triangles, no finer than can be told apart: vertices about `least_mm` apart stand for
// those around them, and two are joined where their surroundings meet three by three (the dual of the Voronoi
// cells on the mesh). A mesh that is as coarse already keeps its own sides. Thread: any. Memory: the heap, in
// proportion to the mesh. Errors: none.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pipeline/model/face_mesh.h"

namespace relievo::ui {

// Each once, two of the mesh's vertices.
using Edges = std::vector<std::array<std::uint32_t, 2>>;
Edges edges_of(const pipeline::FaceMesh& mesh, float least_mm);

}  // namespace relievo::ui

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface as heights over a fixed grid of the head frame, as face recognition from range images takes
// it (Bowyer, Chang, Flynn: A survey of approaches and challenges in 3D and multi-modal 3D + 2D face
// recognition, CVIU 2006). Exact on the triangles: a pixel is a ray along -z through its centre.
// Throws std::bad_alloc. Thread: any.
#pragma once

#include <memory_resource>

#include "pipeline/model/face_mesh.h"
#include "pipeline/model/geometry.h"
#include "pipeline/model/recognition_images.h"

namespace relievo::pipeline {

struct RangeGrid {
  double pitch_mm = 0.5;
  Vec2d first_mm{-100, 130};  // x of the left column, y of the upper row
  int width_px = 401;         // to x = 100
  int height_px = 501;        // to y = -120
};

// Surface seen from behind or at more than 85 degrees has no height worth keeping.
RangeImage measure_range(const FaceMesh& mesh, const RigidTransform& head_from_camera, const RangeGrid& grid,
                         std::pmr::memory_resource* output, std::pmr::memory_resource* scratch);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The middle of a face as heights over its own mean plane, on square cells: every part of the surface
// counts by its area, however densely it was measured. Frame: origin on the plane, x across the pictures
// as far as the plane allows, y down, height towards the cameras; mm.
// Memory: the vectors' own. Thread: any. Errors: none; few cells where little was measured.
#pragma once

#include <memory_resource>
#include <vector>

#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/geometry.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

struct HeightCell {
  int column = 0, row = 0;
  double x_mm = 0, y_mm = 0;  // mean place of what fell into it
  double height_mm = 0;       // mean
  double sigma_mm = 0;        // mean of the stated sigmas: errors of neighbours hang together
};

struct HeightCells {
  explicit HeightCells(std::pmr::memory_resource* memory) : cells(memory) {}
  std::pmr::vector<HeightCell> cells;  // row by row
  double cell_mm = 0;
  int side = 0;        // columns and rows of the lattice
  double covered = 0;  // share of the lattice's inscribed disc
};

// Measured surface within `radius_mm` of the middle of the face, as the pair saw it.
HeightCells make_height_cells(const FaceMesh& mesh, const RectifiedPair& pair, double radius_mm,
                              double cell_mm, StageContext& context);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sheet of paper that comes closest to a surface. Paper bends without stretching: straight lines stay
// in it (a developable surface; do Carmo 1976, 3-5). Held by two sides these lines are parallel (a general
// cylinder: any profile, not only a circle) or meet in one point (a general cone). Seen over a plane
// both are one linear model: where lines meet at distance 1/k along t,
//   height(s, t) = c t + (1 - k t) g(s / (1 - k t)),  k = 0: the cylinder,
// g a cubic spline. Direction and k are searched, c and g follow by least absolute deviations (softened;
// iterated weights, Huber 1981), so that a mirrored lamp or a stray patch moves the sheet little.
// A plane is the sheet whose g is straight. Memory: scratch. Thread: any. Deterministic.
#pragma once

#include <memory_resource>
#include <vector>

#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/geometry.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// The middle of a face as heights over its own mean plane, on square cells: every part of the surface
// counts by its area, however densely it was measured. Frame: origin on the plane, x across the pictures
// as far as the plane allows, y down, height towards the cameras; mm.
// Few cells where little was measured.
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

// How far each cell lies off the sheet, perpendicular, + before it. At least 30 cells. Errors: Cancelled.
Result<std::pmr::vector<double>> off_sheet_mm(const HeightCells& cells, StageContext& context);
std::pmr::vector<double> off_plane_mm(const HeightCells& cells, StageContext& context);

}  // namespace relievo::pipeline

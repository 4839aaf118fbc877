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
// A plane is the sheet whose g is straight. Memory: the caller's vector. Thread: any. Deterministic.
#pragma once

#include <memory_resource>
#include <vector>

#include "pipeline/relief/height_cells.h"

namespace relievo::pipeline {

struct SheetFit {
  double axis_deg = 0;            // of the straight lines: 0 upright in the cells' frame, turning from y to x
  double convergence_per_mm = 0;  // k
  double cost = 0;                // what was made least: mean softened deviation, mm
  std::pmr::vector<double> residual_mm;  // one a cell, perpendicular to the sheet, + before it
  explicit SheetFit(std::pmr::memory_resource* memory) : residual_mm(memory) {}
};

// At least 30 cells. Errors: Cancelled.
Result<SheetFit> fit_sheet(const HeightCells& cells, StageContext& context);
SheetFit fit_plane(const HeightCells& cells, StageContext& context);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rigid motion that lays points on a surface: point to plane, least squares, far ones left out
// more and more strictly (Chen, Medioni 1992). Reaches about 12 mm; never scales. Millimetres.
#pragma once

#include <vector>

#include "firmware/measure/triangle_grid.h"

namespace relievo::firmware::measure {

struct RigidFit {
  pipeline::RigidTransform surface_from_points;
  double moved_mm = 0;  // the middle point's way
  double turned_deg = 0;
};

RigidFit fit_rigidly(const std::vector<Vec3d>& points_mm, const TriangleGrid& surface);

}  // namespace relievo::firmware::measure

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// AdvancingFrontMesher (`advancing-front`): a surface grown over the 3-D Delaunay triangulation of the
// points, always by the most plausible triangle (Cohen-Steiner, Da 2004; CGAL). Takes any cloud; its vertices
// are the measured points. Frame: the left camera's, millimetres. Memory: the mesh in `output`, the rest in
// `scratch`, but for CGAL's own structure, which comes from the heap (about 700 bytes a point). Errors:
// PoorGeometry (no surface of a face's size), OutOfMemory, Cancelled. Thread: any; keeps no state.
#pragma once

#include "pipeline/mesh/meshers/base_sheet.h"

namespace relievo::pipeline {

struct AdvancingFrontMesher {
  int max_points = 160'000;   // more are thinned evenly
  double max_edge_mm = 5;     // longest edge
  double max_edge_ratio = 6;  // longest edge, in usual distances between neighbours
  FinishOptions finish;

  void describe(auto&& field) {
    field("max_points", max_points, OptionRange{1000, 1'000'000}, "more points are thinned evenly");
    field("max_edge_mm", max_edge_mm, OptionRange{0.1, 100}, "longest edge, mm");
    field("max_edge_ratio", max_edge_ratio, OptionRange{1.5, 100},
          "longest edge, in usual distances between neighbours");
    finish.describe(field);
  }
  Result<FaceMesh> mesh(const PointCloud& cloud, StageContext& context) const;
};

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// DelaunayMesher (`delaunay`): the dissertation's surface, a 2.5-D Delaunay triangulation over where
// the left rectified view saw the points (CGAL; the dissertation used Bourke's). Takes any cloud,
// scattered or on a lattice. Long, steep and stray triangles are cut; the same promises as the grid
// mesher hold: one component, manifold, counter-clockwise seen from the cameras, no fringe. Holes
// narrower than the longest edge are bridged by the triangulation itself, between measured points.
// Frame: the left camera's, millimetres. Memory: the mesh in `output`, the rest in `scratch`, but
// for CGAL's own structure, which comes from the heap (about 150 bytes a point).
// Errors: PoorGeometry (no surface of a face's size), OutOfMemory, Cancelled. Thread: any.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/mesh/mesher.h"

namespace relievo::pipeline {

struct DelaunayMesher {
  int max_triangles = 320'000;  // more points are thinned evenly
  double max_edge_mm = 25;      // longest edge
  double max_edge_ratio =
      12;  // longest edge, in distances of points that are spread evenly over as much surface
  double max_incidence_deg = 80;  // steepest triangle, between its normal and the line of sight
  int ear_passes = 3;             // how often triangles that hang on by one edge are trimmed; 0 to 16
  int normal_passes = 1;          // how often normals are averaged over the neighbours; 0 to 16
  double min_area_mm2 = 2500;     // less surface than this is no face

  void describe(auto&& field) {
    field("max_triangles", max_triangles, OptionRange{1000, 10'000'000}, "more points are thinned evenly");
    field("max_edge_mm", max_edge_mm, OptionRange{0.1, 100}, "longest edge, mm");
    field("max_edge_ratio", max_edge_ratio, OptionRange{1.5, 100},
          "longest edge, in usual distances between neighbours");
    field("max_incidence_deg", max_incidence_deg, OptionRange{30, 89},
          "steepest triangle, between its normal and the line of sight, degrees");
    field("ear_passes", ear_passes, OptionRange{0, 16},
          "how often triangles that hang on by one edge are trimmed");
    field("normal_passes", normal_passes, OptionRange{0, 16},
          "how often normals are averaged over the neighbours");
    field("min_area_mm2", min_area_mm2, OptionRange{0, 1e6}, "less surface than this is no face, square mm");
  }
  Result<FaceMesh> mesh(const PointCloud& cloud, StageContext& context) const;
};

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PoissonMesher (`poisson`): the surface whose inside's gradient follows the points' normals (Kazhdan et al.
// 2006), solved by CGAL on a refined Delaunay triangulation, its zero surface taken by marching cubes in a
// band around the points (band_volume.h). Takes any cloud; smooths over what the points leave open, within
// max_gap_mm. Frame: the left camera's, millimetres. Memory: the mesh in `output`, the rest in `scratch`, but
// for CGAL's own structures, which come from the heap (about 3 kB a point). Errors: PoorGeometry (no surface
// of a face's size), OutOfMemory, Cancelled. Thread: any; keeps no state.
#pragma once

#include "pipeline/mesh/meshers/base_sheet.h"

namespace relievo::pipeline {

struct PoissonMesher {
  int max_points = 30'000;  // more are thinned evenly: time and memory go with them
  double voxel_mm = 1;
  double band_voxels = 2.5;  // how far from a point its surface is looked for
  FinishOptions finish;

  void describe(auto&& field) {
    field("max_points", max_points, OptionRange{1000, 1'000'000},
          "more points are thinned evenly: time and memory go with them");
    field("voxel_mm", voxel_mm, OptionRange{0.3, 10}, "side of a voxel, mm");
    field("band_voxels", band_voxels, OptionRange{1.8, 5},
          "how far from a point its surface is looked for, in voxels");
    finish.describe(field);
  }
  Result<FaceMesh> mesh(const PointCloud& cloud, StageContext& context) const;
};

}  // namespace relievo::pipeline

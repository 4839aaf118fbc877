// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// MarchingCubesMesher (`marching-cubes`): a truncated signed distance field around the points, and its zero
// surface by marching cubes with decided ambiguities (band_volume.h). The field is that of Kolluri (2008,
// implicit moving least squares): at each voxel of the band the mean of the distances to the planes of the
// points around, weighted by a Gaussian of a voxel and by 1 / sigma^2; truncated at `band_voxels`. Takes
// any cloud. Frame: the left camera's, millimetres. Memory: arenas only, 8 bytes a voxel of the box.
// Errors: PoorGeometry (no surface of a face's size), OutOfMemory, Cancelled. Thread: any; keeps no state.
#pragma once

#include "pipeline/mesh/meshers/base_sheet.h"

namespace relievo::pipeline {

struct MarchingCubesMesher {
  int max_points = 160'000;  // more are thinned evenly
  double voxel_mm = 0.8;
  double band_voxels = 2.5;  // how far from a point the field reaches
  FinishOptions finish;

  void describe(auto&& field) {
    field("max_points", max_points, OptionRange{1000, 1'000'000}, "more points are thinned evenly");
    field("voxel_mm", voxel_mm, OptionRange{0.3, 10}, "side of a voxel, mm");
    field("band_voxels", band_voxels, OptionRange{1.8, 5},
          "how far from a point the field reaches, in voxels");
    finish.describe(field);
  }
  Result<FaceMesh> mesh(const PointCloud& cloud, StageContext& context) const;
};

}  // namespace relievo::pipeline

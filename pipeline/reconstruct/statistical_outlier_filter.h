// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StatisticalOutlierFilter ("statistical"): a point goes whose mean distance to its k nearest neighbours
// exceeds the mean of that distance over the whole cloud by more than some of its standard deviations (Rusu
// et al., "Towards 3D point cloud based object maps for household environments", 2008). Millimetres.
//
// Neighbours are looked for where the left view has them: in ever wider squares of cells around the point's
// until k are found (at most eight cells away), the k nearest in space of those. A point that has none goes.
// Memory: scratch only. Points that are not finite go. Results do not depend on the number of threads.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/reconstruct/kinds.h"

namespace relievo::pipeline {

struct StatisticalOutlierFilter {
  static constexpr int kMostNeighbours = 64;
  int neighbours = 16;
  double deviations = 2;

  void describe(auto&& field) {
    field("neighbours", neighbours, OptionRange{1, kMostNeighbours},
          "points in space: the mean distance to so many nearest ones is judged");
    field("deviations", deviations, OptionRange{0.1, 100},
          "points in space: standard deviations above the cloud's mean at which a point goes");
  }
  Result<void> reject(PointCloud& cloud, StageContext& context) const;
};

}  // namespace relievo::pipeline

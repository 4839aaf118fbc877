// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The filters of outliers.
#pragma once

#include "pipeline/base/kinds.h"
#include "pipeline/base/options.h"

namespace relievo::pipeline {

// LocalOutlierFilter ("local", the default): takes points out of a cloud that do not belong to its surface:
// flying ones without support among their neighbours, spikes off the plane their neighbours span, and islands
// (the dissertation's Constraint3D "NoOutliers"). Works on the lattice of the left view where the cloud has
// one, on buckets of left_px where it is scattered. Memory: scratch only.
struct LocalOutlierFilter {
  double max_incidence_deg = 78;  // neighbours steeper to the line of sight do not support each other
  double min_support = 0.34;      // share of the 24 places around a point that must support it
  double spike_sigmas = 4;        // distance from the neighbours' plane, in their own scatter; 0 keeps spikes
  double min_island = 0.01;       // islands with less than this share of the points go

  void describe(auto&& field) {
    field("max_incidence_deg", max_incidence_deg, OptionRange{30, 89},
          "steeper neighbours do not support each other");
    field("min_support", min_support, OptionRange{0, 1},
          "share of the places around a point that must support it");
    field("spike_sigmas", spike_sigmas, OptionRange{0, 100},
          "distance from the neighbours' plane, in their scatter; 0 keeps spikes");
    field("min_island", min_island, OptionRange{0, 1}, "islands with less than this share of the points go");
  }
  Result<void> reject(PointCloud& cloud, StageContext& context) const;
};

// StatisticalOutlierFilter ("statistical"): a point goes whose mean distance to its k nearest neighbours
// exceeds the mean of that distance over the whole cloud by more than some of its standard deviations (Rusu
// et al., "Towards 3D point cloud based object maps for household environments", 2008). Millimetres.
//
// Neighbours are looked for where the left view has them: in ever wider squares of cells around the point's
// until k are found (at most eight cells away), the k nearest in space of those. A point that has none goes.
// Memory: scratch only. Points that are not finite go. Results do not depend on the number of threads.
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

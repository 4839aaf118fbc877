// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RbfMesher (`rbf`): the depth of the face as one polyharmonic function (thin plate, r^2 log r, with an
// affine part), fitted to the measured points with centres chosen greedily: it begins with few, and adds
// them where the function is furthest from the points, a few cells apart, until `accuracy_mm` or
// `max_centres` is reached (Carr et al. 2001, section 4). Each centre may leave its point by what its
// sigma allows (their approximating spline, section 5; weights 1 / sigma^2). Takes any cloud.
// Frame: the left camera's, millimetres. Memory: arenas only, max_centres^2 doubles at most.
// Errors: PoorGeometry, OutOfMemory, Cancelled. Thread: any; the pool evaluates.
#pragma once

#include "pipeline/mesh/meshers/depth_sheet.h"

namespace relievo::pipeline {

struct RbfMesher {
  int max_points = 160'000;  // more are thinned evenly
  int max_centres = 1400;
  double accuracy_mm = 0.05;  // no centre is added where the function is as close as this
  double smoothing =
      0.02;  // how much a point's sigma lets the function leave it; 0 goes through every centre
  SheetOptions sheet;

  void describe(auto&& field) {
    field("max_points", max_points, OptionRange{1000, 1'000'000}, "more points are thinned evenly");
    field("max_centres", max_centres, OptionRange{20, 4000}, "how many centres the function may have");
    field("accuracy_mm", accuracy_mm, OptionRange{0.001, 10},
          "no centre is added where the function is as close to the points as this, mm");
    field("smoothing", smoothing, OptionRange{0, 1000},
          "how much a point's sigma lets the function leave it");
    sheet.describe(field);
  }
  Result<FaceMesh> mesh(const PointCloud& cloud, StageContext& context) const;
};

}  // namespace relievo::pipeline

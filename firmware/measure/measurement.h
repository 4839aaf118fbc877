// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measurement: how far a model is from the truth. Millimetres; shares of 1.
//   accuracy  from points spread evenly over the model's measured surface, where it is judged face
//   interior  the same, where the whole 23 pixel window around is judged face
//   complete  share of the judged true face with model surface within the distance
//   outliers  share of the model's measured surface further than 3 mm from the true head
//   sigma     share of vertices whose error is within one, and 1.96, of their own sigma_mm: honest
//             models say 0.68 and 0.95
// The model is first moved rigidly onto the truth (its calibration is an estimate); never scaled.
// Thread: any.
#pragma once

#include <cstddef>
#include <vector>

#include "firmware/measure/triangle_grid.h"
#include "firmware/measure/truth_view.h"
#include "pipeline/model/face_mesh.h"

namespace relievo::firmware::measure {

// The rigid motion that lays points on a surface: point to plane, least squares, far ones left out
// more and more strictly (Chen, Medioni 1992). Reaches about 12 mm; never scales. Millimetres.
struct RigidFit {
  pipeline::RigidTransform surface_from_points;
  double moved_mm = 0;  // the middle point's way
  double turned_deg = 0;
};

RigidFit fit_rigidly(const std::vector<Vec3d>& points_mm, const TriangleGrid& surface);

struct Measurement {
  double accuracy_median_mm = 0, accuracy_p95_mm = 0;
  double interior_median_mm = 0, interior_p95_mm = 0;
  double complete_quarter_mm = 0, complete_half_mm = 0, complete_1mm = 0;
  double outliers_3mm = 0;
  double within_sigma = 0, within_196_sigma = 0;
  std::size_t measured_vertices = 0;
  double moved_mm = 0, turned_deg = 0;
};

Measurement measure(const pipeline::FaceMesh& mesh, const TruthView& truth, const Surface& true_surface);

}  // namespace relievo::firmware::measure

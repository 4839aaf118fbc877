// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sews what a completion added to what was measured: a constrained Delaunay triangulation of the gap between them, laid
// flat (gap_triangulation.h). What was measured stays bit for bit where it is.
// Memory: the mesh in `output`, the rest in scratch; CGAL's triangulation of the gap takes from the heap. Thread: any.
#pragma once

#include "pipeline/mesh/completion/unrolled_head.h"
#include "pipeline/model/geometry.h"
#include "pipeline/stage.h"

namespace relievo::pipeline {

struct SewingRules {
  double cell_mm = 1.5;          // of the head laid flat
  double longest_edge_mm = 12;   // wider gaps stay open
  double sigma_mm = 0;           // of an added place at the seam,
  double sigma_per_mm = 0;       // and how much more for each mm from it;
  const FaceRelief* sigma = nullptr;  // or of every cell, where a completion knows it better
};

// `mesh` is the measured surface that `head` was made of.
FaceMesh sewn(FaceMesh mesh, UnrolledHead& head, const RigidTransform& camera_from_head, const SewingRules& rules, StageContext& context);

}  // namespace relievo::pipeline

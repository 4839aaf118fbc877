// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sews what a completion added to what was measured: a constrained Delaunay triangulation of the gap between
// them, laid flat (gap_triangulation.h). What was measured stays bit for bit where it is. Memory: the mesh in
// `output`, the rest in scratch; CGAL's triangulation of the gap takes from the heap. Thread: any.
#pragma once

#include <functional>
#include <optional>

#include "pipeline/base/stage.h"
#include "pipeline/mesh/completion/unrolled_head.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct SewingRules {
  double longest_edge_mm = 12;        // wider gaps stay open
  double sigma_mm = 0;                // of an added place at the seam,
  double sigma_per_mm = 0;            // and how much more for each mm from it;
  std::optional<FaceRelief> sigma{};  // or of every cell, where a completion knows it better
};

// Lays the measured surface flat on cells of `cell_mm`, lets `propose` add to it (UnrolledHead::add), and
// sews that on. A surface in which no head is found, or to which nothing was added, comes back as it is.
// `across`: as find_head_frame() wants it. Errors: Cancelled, OutOfMemory.
Result<FaceMesh> complete_head(FaceMesh mesh, const Vec3d& across, double cell_mm,
                               const std::function<SewingRules(UnrolledHead&)>& propose,
                               StageContext& context);

}  // namespace relievo::pipeline

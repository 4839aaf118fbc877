// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuts a lattice's surface along smooth lines a fraction of a cell inside its edges: the share of surface
// around each node (a Gaussian) is a field, and triangles are cut where it falls to a level (marching
// triangles on the lattice). The outline is smoothed by more than the rims of holes, whose shape is the
// face's. Nodes closer to a line than a quarter of an edge are moved onto it, along the edge, so that no
// slivers arise (Labelle, Shewchuk 2007). Every vertex stays on an edge it was on.
#pragma once

#include <memory_resource>
#include <optional>

#include "pipeline/mesh/lattice/cell_mask.h"
#include "pipeline/mesh/lattice/head_chart.h"
#include "pipeline/mesh/lattice/lattice_surface.h"
#include "pipeline/model/face_mesh.h"

namespace relievo::pipeline {

// The outline that every face is cut to, a closed curve in the head's frame: where an ellipsoid around the
// tip of the nose meets the skin, along the hairline and before the ears, and along the jaw below the chin,
// whose height follows the person's. It knows nothing of where a picture's measurements end: what they do not
// reach is left to the edge of what was measured. Thread: any.
struct FaceOutline {
  HeadChart chart;
  double below_mm = 82;  // of the tip of the nose, on the plane of symmetry

  // How far inside the curve a point lies, about in mm near it; negative outside.
  float depth_mm(const Vec3f& from_chart_centre_mm) const;
};

// Sigmas of the Gaussians; 0 leaves that line on the lattice.
struct OutlineSmoothing {
  float outline_mm = 0;
  float rims_mm = 0;
};

// `inside` is what lies within the outline, holes included. Triangles that the move would make steeper
// than `max_slope` are left out. `outline`: nothing beyond this curve is kept. A mesh of only vertices that a
// triangle uses, measured where both nodes of their edge are, with sigmas along the line of sight and without
// normals; in the lattice's frame. Throws std::bad_alloc when `memory` is used up.
FaceMesh cut_outline(const PointLattice& lattice, const CellMask& inside, const OutlineSmoothing& smoothing,
                     const std::optional<FaceOutline>& outline, float max_slope,
                     std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline

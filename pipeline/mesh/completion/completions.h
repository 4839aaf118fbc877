// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What one side of the face hides, the other side shows: the measured surface is mirrored at the plane of
// symmetry found in it and laid where nothing was measured (UnrolledHead), moved by what the two differ
// along their seam, and sewn on (head_sewing.h). Its sigma is that of asymmetry: sigma_mm, and sigma_per_mm
// more for every millimetre from the seam. Errors: those of Completion. Thread: any.
#pragma once

#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/base/kinds.h"
#include "pipeline/base/options.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

// Nothing is added. Thread: any.
struct MeasuredOnly {
  Result<FaceMesh> complete(FaceMesh mesh, const Vec3d&, StageContext& context) const {
    if (context.stop()) return stopped();
    return mesh;
  }
};

struct SymmetricCompletion {
  double cell_mm = 1.5;         // between completed vertices
  double longest_edge_mm = 12;  // wider gaps between both sides' surfaces stay open
  double sigma_mm = 0.7;
  double sigma_per_mm = 0.015;
  Result<void> check() const;

  void describe(auto&& field) {
    field("cell_mm", cell_mm, OptionRange{0.5, 10}, "between completed vertices, mm");
    field("longest_edge_mm", longest_edge_mm, OptionRange{1, 50}, "longer edges join nothing, mm");
    field("sigma_mm", sigma_mm, OptionRange{0, 20},
          "standard deviation of a completed place at the seam, mm");
    field("sigma_per_mm", sigma_per_mm, OptionRange{0, 1}, "how much more for each mm from the seam");
  }
  Result<FaceMesh> complete(FaceMesh mesh, const Vec3d& across, StageContext& context) const;
};

// The measured face becomes a closed head, from the crown to where the neck is cut: the generic head
// (generic_head.h) is fitted to the measured radii by robust least squares with its modes' own spread as
// prior, bent by what it differs beside the seam (a thin plate), and sewn on (head_sewing.h). Its sigma is
// the posterior's, with what the model cannot show; at the neck's end there is no head to be near to. Errors:
// those of Completion. Thread: any.

// Globe: nodes spread evenly over a sphere, an icosahedron whose triangles are quartered again and again.
// Values at its nodes stay smooth when it is refined (Loop, Smooth subdivision surfaces based on triangles,
// 1987). Memory: the resource given. Throws std::bad_alloc. Thread: any.
struct Globe {
  // Quartered `times` times: 10 * 4^times + 2 nodes.
  Globe(int times, std::pmr::memory_resource* memory);

  // Quarters every triangle; new nodes follow. Each of `fields` has one value a node and gets as many as
  // there are then. The directions are smoothed as the fields are, or these would show the icosahedron's
  // edges as folds; without fields the nodes keep their places.
  void quarter(std::span<std::pmr::vector<double>> fields);

  std::pmr::vector<Vec3d> direction;     // unit length; the first looks along -z
  std::pmr::vector<Triangle> triangles;  // counter-clockwise from outside
};

struct GenericHeadCompletion {
  double misfit_mm = 1.5;  // what a person differs by from all that the model can be, one standard deviation

  void describe(auto&& field) {
    field("misfit_mm", misfit_mm, OptionRange{0.1, 20}, "what a person differs by from the model, mm");
  }
  Result<FaceMesh> complete(FaceMesh mesh, const Vec3d& across, StageContext& context) const;
};

}  // namespace relievo::pipeline

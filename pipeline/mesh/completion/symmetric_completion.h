// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What one side of the face hides, the other side shows: the measured surface is mirrored at the plane of
// symmetry found in it and laid where nothing was measured (unrolled_head.h), moved by what the two differ
// along their seam, and sewn on (head_sewing.h). Its sigma is that of asymmetry: sigma_mm, and sigma_per_mm
// more for every millimetre from the seam. Errors: those of Completion. Thread: any.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/mesh/completion/completion.h"

namespace relievo::pipeline {

// Nothing is added. Thread: any.
struct MeasuredOnly {
  Result<FaceMesh> complete(FaceMesh mesh, const Vec3d&, StageContext& context) const {
    if (context.stop()) return Error{Errc::Cancelled, "completion was stopped"};
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

}  // namespace relievo::pipeline

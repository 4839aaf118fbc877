// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The measured face becomes a closed head, from the crown to where the neck is cut: the generic head
// (generic_head.h) is fitted to the measured radii by robust least squares with its modes' own spread as
// prior, bent by what it differs beside the seam (a thin plate), and sewn on (head_sewing.h). Its sigma is
// the posterior's, with what the model cannot show; at the neck's end there is no head to be near to. Errors:
// those of Completion. Thread: any.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/mesh/completion/completion.h"

namespace relievo::pipeline {

struct GenericHeadCompletion {
  double misfit_mm = 1.5;  // what a person differs by from all that the model can be, one standard deviation

  void describe(auto&& field) {
    field("misfit_mm", misfit_mm, OptionRange{0.1, 20}, "what a person differs by from the model, mm");
  }
  Result<FaceMesh> complete(FaceMesh mesh, const Vec3d& across, StageContext& context) const;
};

}  // namespace relievo::pipeline

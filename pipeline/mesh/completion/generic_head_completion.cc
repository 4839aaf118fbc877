// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/generic_head_completion.h"

#include <utility>

#include "pipeline/mesh/completion/fitted_head.h"
#include "pipeline/mesh/completion/head_sewing.h"
#include "pipeline/mesh/completion/unrolled_head.h"

namespace relievo::pipeline {

Result<void> GenericHeadOptions::check() const {
  if (!(cell_mm >= 0.5 && cell_mm <= 10))
    return Error{Errc::InvalidInput, "cell_mm must lie in 0.5 .. 10"}.at("generic-head");
  if (!(longest_edge_mm >= 2 * cell_mm && longest_edge_mm <= 50))
    return Error{Errc::InvalidInput, "longest_edge_mm must lie between two cells and 50"}.at("generic-head");
  if (!(misfit_mm >= 0.1 && misfit_mm <= 20))
    return Error{Errc::InvalidInput, "misfit_mm must lie in 0.1 .. 20"}.at("generic-head");
  return {};
}

Result<FaceMesh> GenericHeadCompletion::complete(FaceMesh mesh, const Vec3d& across,
                                                 StageContext& context) const {
  const auto fit = [&](UnrolledHead& head) {
    FittedHead fitted = fit_generic_head(head, options_.cell_mm, options_.misfit_mm);
    head.add([&fitted](int c, int r) { return fitted.radius.z(c, r); }, options_.cell_mm, context.scratch);
    return SewingRules{options_.longest_edge_mm, 0, 0, std::move(fitted.sigma)};
  };
  return complete_head(std::move(mesh), across, options_.cell_mm, fit, context);
}

}  // namespace relievo::pipeline

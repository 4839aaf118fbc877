// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/generic_head_completion.h"

#include <utility>

#include "pipeline/mesh/completion/fitted_head.h"
#include "pipeline/mesh/completion/head_sewing.h"
#include "pipeline/mesh/completion/unrolled_head.h"

namespace relievo::pipeline {

Result<void> GenericHeadOptions::check() const {
  if (longest_edge_mm < 2 * cell_mm)
    return Error{Errc::InvalidInput, "longest_edge_mm must be at least two cells"}.at("generic-head");
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

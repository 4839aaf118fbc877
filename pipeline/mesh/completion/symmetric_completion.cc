// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/symmetric_completion.h"

#include <utility>

#include "pipeline/mesh/completion/head_sewing.h"

namespace relievo::pipeline {

Result<void> SymmetricCompletionOptions::check() const {
  if (longest_edge_mm < 2 * cell_mm)
    return Error{Errc::InvalidInput, "longest_edge_mm must be at least two cells"}.at("symmetric");
  return {};
}

Result<FaceMesh> SymmetricCompletion::complete(FaceMesh mesh, const Vec3d& across,
                                               StageContext& context) const {
  const auto mirror = [&](UnrolledHead& head) {
    head.add([&head](int c, int r) { return head.own.z(head.own.columns() - 1 - c, r); }, options_.cell_mm,
             context.scratch);
    return SewingRules{options_.longest_edge_mm, options_.sigma_mm, options_.sigma_per_mm};
  };
  return complete_head(std::move(mesh), across, options_.cell_mm, mirror, context);
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/symmetric_completion.h"

#include "pipeline/mesh/completion/head_sewing.h"
#include "pipeline/mesh/completion/unrolled_head.h"
#include "pipeline/mesh/landmarks/head_frame.h"

namespace relievo::pipeline {

Result<void> SymmetricCompletionOptions::check() const {
  if (!(cell_mm >= 0.5 && cell_mm <= 10)) return Error{Errc::InvalidInput, "cell_mm must lie in 0.5 .. 10"}.at("symmetric");
  if (!(longest_edge_mm >= 2 * cell_mm && longest_edge_mm <= 50))
    return Error{Errc::InvalidInput, "longest_edge_mm must lie between two cells and 50"}.at("symmetric");
  if (!(sigma_mm >= 0 && sigma_mm <= 20 && sigma_per_mm >= 0 && sigma_per_mm <= 1))
    return Error{Errc::InvalidInput, "sigma_mm must lie in 0 .. 20, sigma_per_mm in 0 .. 1"}.at("symmetric");
  return {};
}

Result<FaceMesh> SymmetricCompletion::complete(FaceMesh mesh, const Vec3d& across, StageContext& context) const {
  const Result<HeadFrame> frame = find_head_frame(mesh, {}, context, across);
  if (!frame) {
    if (frame.error().code == Errc::PoorGeometry) return mesh;
    return frame.error();
  }
  const Arena::Mark mark(context.scratch);
  UnrolledHead head(mesh, frame->head_from_camera, options_.cell_mm, context.scratch);
  head.add([&](int c, int r) { return head.own.z(head.own.columns() - 1 - c, r); }, options_.cell_mm, context.scratch);
  if (context.stop()) return Error{Errc::Cancelled, "completion was stopped"};
  return sewn(std::move(mesh), head, inverse(frame->head_from_camera),
              {options_.cell_mm, options_.longest_edge_mm, options_.sigma_mm, options_.sigma_per_mm, nullptr}, context);
}

}  // namespace relievo::pipeline

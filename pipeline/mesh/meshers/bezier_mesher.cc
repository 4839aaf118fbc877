// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/meshers/bezier_mesher.h"

#include "pipeline/mesh/meshers/bezier_net.h"

namespace relievo::pipeline {

Result<void> BezierMesherOptions::check() const {
  if (max_points < 1000 || max_points > 1'000'000)
    return Error{Errc::InvalidInput, "max_points must lie in 1000 .. 1000000"}.at("mesher.bezier");
  if (!(patch_mm >= 0.5 && patch_mm <= 50) || !(bending >= 1e-6 && bending <= 1000))
    return Error{Errc::InvalidInput, "patch_mm 0.5 .. 50, bending 1e-6 .. 1000"}.at("mesher.bezier");
  return sheet.check("mesher.bezier");
}

Result<FaceMesh> BezierMesher::mesh(const PointCloud& cloud, StageContext& context) const {
  RELIEVO_TRY(options_.check());
  if (context.stop()) return Error{Errc::Cancelled, "meshing was stopped"};
  RELIEVO_TRY_ASSIGN(const FaceMesh base, base_sheet(cloud, options_.max_points, context));
  const DepthSamples samples = sample_depths(base, &context.scratch);
  const BezierNet net(samples, options_.patch_mm, options_.bending, &context.scratch);
  if (context.stop()) return Error{Errc::Cancelled, "meshing was stopped"};
  return mesh_sheet(
      base, samples, [&net](auto us, double v, auto depths) { net.depths(us, v, depths); }, options_.sheet,
      context);
}

}  // namespace relievo::pipeline

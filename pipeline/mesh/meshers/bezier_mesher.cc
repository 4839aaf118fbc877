// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/meshers/bezier_mesher.h"

#include "pipeline/mesh/meshers/bezier_net.h"

namespace relievo::pipeline {

Result<FaceMesh> BezierMesher::mesh(const PointCloud& cloud, StageContext& context) const {
  if (context.stop()) return Error{Errc::Cancelled, "meshing was stopped"};
  RELIEVO_TRY_ASSIGN(const FaceMesh base, base_sheet(cloud, max_points, context));
  const DepthSamples samples = sample_depths(base, &context.scratch);
  const BezierNet net(samples, patch_mm, bending, &context.scratch);
  if (context.stop()) return Error{Errc::Cancelled, "meshing was stopped"};
  return mesh_sheet(
      base, samples, [&net](auto us, double v, auto depths) { net.depths(us, v, depths); }, sheet, context);
}

}  // namespace relievo::pipeline

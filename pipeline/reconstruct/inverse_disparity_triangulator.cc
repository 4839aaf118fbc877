// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/reconstruct/inverse_disparity_triangulator.h"

#include <algorithm>
#include <cmath>

namespace relievo::pipeline {

Result<PointCloud> InverseDisparityTriangulator::triangulate(const RectifiedPair& pair,
                                                             const MatchSet& matches,
                                                             StageContext& context) const {
  const auto accepted =
      static_cast<std::size_t>(std::count_if(matches.matches.begin(), matches.matches.end(),
                                             [](const Match& match) { return match.rejected_by == 0; }));
  if (accepted < 3)
    return Error{Errc::TooFewMatches, "every match was rejected: loosen the constraints or capture again"};
  PointCloud cloud(&context.output);
  cloud.lattice_step_px = matches.lattice_step_px;
  cloud.right_camera_mm = pair.right_camera_mm();
  cloud.points.reserve(accepted);
  const Rotation left_from_rectified = transposed(pair.rectified_from_left);
  for (std::size_t k = 0; k < matches.matches.size(); ++k) {
    if (k % 65536 == 0 && context.stop()) return Error{Errc::Cancelled, "stopped while triangulating"};
    const Match& match = matches.matches[k];
    if (match.rejected_by != 0) continue;
    const double z = pair.depth_mm(match.disparity_px);
    if (!(z >= pair.near_mm && z <= pair.far_mm)) continue;  // outside the volume: not this person
    const double u = (match.left_px.x - pair.left_centre_px.x) / pair.focal_px;
    const double v = (match.left_px.y - pair.left_centre_px.y) / pair.focal_px;
    const Vec3d p = apply(left_from_rectified, {u * z, v * z, z});
    const double along = std::sqrt(1 + u * u + v * v) * z * z / (pair.focal_px * pair.baseline_mm);
    cloud.points.push_back({{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)},
                            match.left_px,
                            static_cast<float>(along * match.sigma_px)});
  }
  if (cloud.points.size() < 3)
    return Error{Errc::TooFewMatches,
                 "nothing lies between the near and far limits: stand closer to the marked distance"};
  return cloud;
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/reconstruct/linear_triangulator.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "pipeline/base/solving.h"

namespace relievo::pipeline {

Result<PointCloud> LinearTriangulator::triangulate(const RectifiedPair& pair, const MatchSet& matches,
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
  const Eigen::Vector3d centre(pair.baseline_mm, 0, 0);  // of the right camera, rectified frame
  for (std::size_t k = 0; k < matches.matches.size(); ++k) {
    if (k % 16384 == 0 && context.stop()) return Error{Errc::Cancelled, "stopped while triangulating"};
    const Match& match = matches.matches[k];
    if (match.rejected_by != 0) continue;
    const double f = pair.focal_px;
    const Eigen::Vector3d left((match.left_px.x - pair.left_centre_px.x) / f,
                               (match.left_px.y - pair.left_centre_px.y) / f, 1);
    const Eigen::Vector3d right((match.left_px.x - match.disparity_px - pair.right_centre_px.x) / f,
                                (match.left_px.y - pair.right_centre_px.y) / f, 1);
    Eigen::Matrix<double, 6, 5> system = Eigen::Matrix<double, 6, 5>::Zero();
    Eigen::Matrix<double, 6, 1> known = Eigen::Matrix<double, 6, 1>::Zero();
    system.topLeftCorner<3, 3>().setIdentity();
    system.bottomLeftCorner<3, 3>().setIdentity();
    system.block<3, 1>(0, 3) = -left;
    system.block<3, 1>(3, 4) = -right;
    known.tail<3>() = centre;
    const Eigen::Matrix<double, 5, 1> solution =
        solved<5>(system.transpose() * system, system.transpose() * known);
    const double z = solution(2);
    if (!(z >= pair.near_mm && z <= pair.far_mm)) continue;  // outside the volume: not this person
    const Vec3d p = apply(left_from_rectified, {solution(0), solution(1), z});
    const double along = left.norm() * z * z / (f * pair.baseline_mm);
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

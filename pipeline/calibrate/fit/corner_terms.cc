// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/fit/corner_terms.h"

namespace relievo::pipeline::bundle {

Eigen::Matrix3d cross(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Vector2d pixel_of(const CameraIntrinsics& c, const Eigen::Vector3d& p, CameraJacobian* by_camera,
                         PointJacobian* by_point) {
  const double x = p.x() / p.z();
  const double y = p.y() / p.z();
  const double* k = c.distortion;
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const double xd = x * radial + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x);
  const double yd = y * radial + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y;
  const double fx = c.focal_px.x;
  const double fy = c.focal_px.y;
  if (by_camera != nullptr) {
    const double r4 = r2 * r2;
    *by_camera << xd, 0, 1, 0, fx * x * r2, fx * x * r4, fx * 2 * x * y, fx * (r2 + 2 * x * x),
        fx * x * r4 * r2, 0, yd, 0, 1, fy * y * r2, fy * y * r4, fy * (r2 + 2 * y * y), fy * 2 * x * y,
        fy * y * r4 * r2;
  }
  if (by_point != nullptr) {
    const double slope = 2 * (k[0] + r2 * (2 * k[1] + r2 * 3 * k[4]));  // of radial, by x over x
    Eigen::Matrix2d by_plane;
    by_plane << radial + slope * x * x + 2 * k[2] * y + 6 * k[3] * x,
        slope * x * y + 2 * k[2] * x + 2 * k[3] * y, slope * x * y + 2 * k[2] * x + 2 * k[3] * y,
        radial + slope * y * y + 6 * k[2] * y + 2 * k[3] * x;
    PointJacobian plane_by_point;
    plane_by_point << 1 / p.z(), 0, -x / p.z(), 0, 1 / p.z(), -y / p.z();
    *by_point = Eigen::Vector2d(fx, fy).asDiagonal() * by_plane * plane_by_point;
  }
  return {fx * xd + c.centre_px.x, fy * yd + c.centre_px.y};
}

}  // namespace relievo::pipeline::bundle

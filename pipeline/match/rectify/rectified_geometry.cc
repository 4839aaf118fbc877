// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/rectify/rectified_geometry.h"

#include <algorithm>
#include <cmath>

#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

Vec2d undistorted(const CameraIntrinsics& camera, Vec2d pixel) {
  const double* k = camera.distortion;
  const double xd = (pixel.x - camera.centre_px.x) / camera.focal_px.x;
  const double yd = (pixel.y - camera.centre_px.y) / camera.focal_px.y;
  double x = xd;
  double y = yd;
  for (int i = 0; i < 20; ++i) {  // fixed point; far more rounds than mild distortion needs
    const double r2 = x * x + y * y;
    const double radial = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
    x = (xd - 2 * k[2] * x * y - k[3] * (r2 + 2 * x * x)) / radial;
    y = (yd - k[2] * (r2 + 2 * y * y) - 2 * k[3] * x * y) / radial;
  }
  return {x, y};
}

struct Box {
  double left = 1e30, top = 1e30, right = -1e30, bottom = -1e30;
  void include(double x, double y) {
    left = std::min(left, x);
    right = std::max(right, x);
    top = std::min(top, y);
    bottom = std::max(bottom, y);
  }
};

// The picture's border, seen in the rectified view with the centre at zero.
Box border_box(const CameraIntrinsics& camera, const Rotation& rectified_from_camera, double focal_px) {
  Box box;
  constexpr int kSteps = 32;
  for (int i = 0; i <= kSteps; ++i)
    for (int side = 0; side < 4; ++side) {
      const double t = static_cast<double>(i) / kSteps;
      const double w = camera.width_px - 1.0;
      const double h = camera.height_px - 1.0;
      const Vec2d pixel = side == 0   ? Vec2d{t * w, 0}
                          : side == 1 ? Vec2d{t * w, h}
                          : side == 2 ? Vec2d{0, t * h}
                                      : Vec2d{w, t * h};
      const Vec2d ideal = undistorted(camera, pixel);
      const Vec3d ray = apply(rectified_from_camera, {ideal.x, ideal.y, 1});
      if (ray.z < 0.2) continue;  // beyond 78 degrees: lay_windows refuses by size
      box.include(focal_px * ray.x / ray.z, focal_px * ray.y / ray.z);
    }
  return box;
}

}  // namespace

Vec2d source_pixel(const CameraIntrinsics& camera, const Rotation& rectified_from_camera, double focal_px,
                   Vec2d centre_px, Vec2d at) {
  const Vec3d ray = apply(transposed(rectified_from_camera),
                          {(at.x - centre_px.x) / focal_px, (at.y - centre_px.y) / focal_px, 1});
  const double x = ray.x / ray.z;
  const double y = ray.y / ray.z;
  const double* k = camera.distortion;
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const double xd = x * radial + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x);
  const double yd = y * radial + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y;
  return {camera.focal_px.x * xd + camera.centre_px.x, camera.focal_px.y * yd + camera.centre_px.y};
}

Result<void> lay_windows(const StereoCalibration& calibration, const RectifierOptions& options,
                         RectifiedPair& pair) {
  const RigidTransform left_from_right = inverse(calibration.right_from_left);
  const Vec3d baseline = left_from_right.translation_mm;  // right camera's centre, left frame
  const double baseline_mm = length(baseline);
  // Sensors that lie on their side have the baseline along y, either way: the rows of the window are the
  // baseline's, so the window stands upright as the people do.
  const double sideways = std::hypot(baseline.x, baseline.y);
  if (!(baseline_mm > 1) || sideways < 0.5 * baseline_mm)
    return Error{Errc::InvalidInput, "the cameras must stand beside each other, not behind"};
  if (baseline.x <= 0 && -baseline.x >= std::abs(baseline.y))
    return Error{Errc::InvalidInput,
                 "the right camera must stand to the right of the left one: are the cameras swapped?"};
  const Vec3d x = times(baseline, 1 / baseline_mm);
  const Vec3d right_axis = apply(left_from_right.rotation, {0, 0, 1});
  Vec3d z = {right_axis.x, right_axis.y, right_axis.z + 1};
  z = unit(along(z, -dot(z, x), x));
  const Vec3d y = cross(z, x);
  pair.rectified_from_left = {{x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z}};
  // rectified_from_right = rectified_from_left * left_from_right
  const Rotation back = transposed(left_from_right.rotation);  // rows become left_from_right's columns
  for (int row = 0; row < 3; ++row) {
    const Vec3d r = {pair.rectified_from_left.m[3 * row], pair.rectified_from_left.m[3 * row + 1],
                     pair.rectified_from_left.m[3 * row + 2]};
    const Vec3d q = apply(back, r);
    pair.rectified_from_right.m[3 * row] = q.x;
    pair.rectified_from_right.m[3 * row + 1] = q.y;
    pair.rectified_from_right.m[3 * row + 2] = q.z;
  }
  pair.right_from_left = calibration.right_from_left;
  pair.baseline_mm = baseline_mm;
  pair.near_mm = options.near_mm;
  pair.far_mm = options.far_mm;
  pair.focal_px = (calibration.left.focal_px.x + calibration.left.focal_px.y + calibration.right.focal_px.x +
                   calibration.right.focal_px.y) /
                  4;

  const Box left = border_box(calibration.left, pair.rectified_from_left, pair.focal_px);
  const Box right = border_box(calibration.right, pair.rectified_from_right, pair.focal_px);
  const double top = std::max(left.top, right.top);
  const double bottom = std::min(left.bottom, right.bottom);
  const double width = std::max(left.right - left.left, right.right - right.left);
  pair.width_px = static_cast<int>(std::ceil(width)) + 1;
  pair.height_px = static_cast<int>(std::floor(bottom - top)) + 1;
  if (pair.width_px > options.longest_side_px || pair.height_px < 64)
    return Error{Errc::InvalidInput, "the two cameras do not look at a common volume: calibrate again"};
  const auto centred = [width](const Box& box) { return width / 2 - (box.left + box.right) / 2; };
  pair.left_centre_px = {centred(left), -top};
  pair.right_centre_px = {centred(right), -top};
  return {};
}

}  // namespace relievo::pipeline

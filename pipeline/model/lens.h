// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a lens does to a ray (Brown 1971; the order of CameraIntrinsics::distortion). Rays are points of the
// plane z = 1 of the camera's frame. Thread: any. Errors: none.
#pragma once

#include "pipeline/model/calibration.h"

namespace relievo::pipeline {

inline Vec2d pixel_of_ray(const CameraIntrinsics& camera, Vec2d ray) {
  const auto [x, y] = ray;
  const double* k = camera.distortion;
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const double xd = x * radial + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x);
  const double yd = y * radial + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y;
  return {camera.focal_px.x * xd + camera.centre_px.x, camera.focal_px.y * yd + camera.centre_px.y};
}

// By fixed point, which contracts where the picture does not fold over; mild distortion needs far less.
inline Vec2d ray_of_pixel(const CameraIntrinsics& camera, Vec2d pixel) {
  const double* k = camera.distortion;
  const double xd = (pixel.x - camera.centre_px.x) / camera.focal_px.x;
  const double yd = (pixel.y - camera.centre_px.y) / camera.focal_px.y;
  double x = xd, y = yd;
  for (int i = 0; i < 20; ++i) {
    const double r2 = x * x + y * y;
    const double radial = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
    x = (xd - 2 * k[2] * x * y - k[3] * (r2 + 2 * x * x)) / radial;
    y = (yd - k[2] * (r2 + 2 * y * y) - 2 * k[3] * x * y) / radial;
  }
  return {x, y};
}

}  // namespace relievo::pipeline

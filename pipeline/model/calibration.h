// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a calibration knows. Camera model: pinhole with Brown-Conrady distortion in OpenCV's order
// k1 k2 p1 p2 k3 (Brown 1971; Zhang 2000). Millimetres, pixels; right_from_left maps a point of the
// left camera's frame into the right camera's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct CameraIntrinsics {
  Vec2d focal_px;
  Vec2d centre_px;
  double distortion[5] = {0, 0, 0, 0, 0};
  int width_px = 0;
  int height_px = 0;
};

// What a lens does to a ray: a point of the plane z = 1 of the camera's frame.
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

// Which cameras: each in words that tell it from all others ("serial 40123456", "at /dev/v4l/by-path/…");
// empty where nobody knows. Printable ASCII, kMaxCameraWords at most.
struct RigCameras {
  std::string left;
  std::string right;
  bool operator==(const RigCameras&) const = default;
};
inline constexpr std::size_t kMaxCameraWords = 255;

struct StereoCalibration {
  CameraIntrinsics left;
  CameraIntrinsics right;
  RigidTransform right_from_left;
  double rms_px = 0;             // pair reprojection rms of the views used; 0 where unknown
  double epipolar_shift_px = 0;  // what a whole board misses its epipolar lines by in a picture that had no
                                 // part in the fit, rms over the board (offset and tilt); 0 where unknown
  std::uint32_t revision = 0;
  RigCameras cameras = {};  // that it was made with
};

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A camera turned upright whose pictures nobody turns back: what it delivers lies on its side. The upright
// picture, and the calibration that goes with it, turned a quarter to one side or the other; and points
// of the lying camera's frame back in the upright one's. Exact: no pixel is resampled.
#pragma once

#include <cstring>

#include "hal/picture_file.h"
#include "pipeline/model/calibration.h"

namespace relievo::test {

enum class Side { Clockwise, Counterclockwise };

inline pipeline::Rotation lying_from_upright(Side side) {
  if (side == Side::Clockwise) return {{0, -1, 0, 1, 0, 0, 0, 0, 1}};
  return {{0, 1, 0, -1, 0, 0, 0, 0, 1}};
}

inline pipeline::Vec2d laid(const pipeline::Vec2d& at, int width_px, int height_px, Side side) {
  if (side == Side::Clockwise) return {height_px - 1 - at.y, at.x};
  return {at.y, width_px - 1 - at.x};
}

inline hal::Picture laid(const ImageView& upright, Side side) {
  hal::Picture lying;
  lying.width_px = upright.height_px;
  lying.height_px = upright.width_px;
  lying.format = upright.format;
  const auto pixel = static_cast<std::size_t>(bytes_per_pixel(upright.format));
  lying.bytes.resize(static_cast<std::size_t>(lying.width_px) * static_cast<std::size_t>(lying.height_px) *
                     pixel);
  for (int y = 0; y < upright.height_px; ++y)
    for (int x = 0; x < upright.width_px; ++x) {
      const int to_x = side == Side::Clockwise ? upright.height_px - 1 - y : y;
      const int to_y = side == Side::Clockwise ? x : upright.width_px - 1 - x;
      std::memcpy(
          lying.bytes.data() + (static_cast<std::size_t>(to_y) * static_cast<std::size_t>(lying.width_px) +
                                static_cast<std::size_t>(to_x)) *
                                   pixel,
          upright.row(y) + static_cast<std::size_t>(x) * pixel, pixel);
    }
  return lying;
}

inline pipeline::CameraIntrinsics laid(const pipeline::CameraIntrinsics& upright, Side side) {
  pipeline::CameraIntrinsics lying = upright;
  lying.focal_px = {upright.focal_px.y, upright.focal_px.x};
  lying.centre_px = laid(upright.centre_px, upright.width_px, upright.height_px, side);
  const double sign = side == Side::Clockwise ? 1 : -1;
  lying.distortion[2] = sign * upright.distortion[3];
  lying.distortion[3] = -sign * upright.distortion[2];
  lying.width_px = upright.height_px;
  lying.height_px = upright.width_px;
  return lying;
}

inline pipeline::StereoCalibration laid(const pipeline::StereoCalibration& upright, Side side) {
  pipeline::StereoCalibration lying = upright;
  lying.left = laid(upright.left, side);
  lying.right = laid(upright.right, side);
  const pipeline::Rotation turn = lying_from_upright(side);
  lying.right_from_left.translation_mm = apply(turn, upright.right_from_left.translation_mm);
  const pipeline::Rotation back = transposed(turn);
  for (int column = 0; column < 3; ++column) {  // turn * right_from_left * back, column by column
    const pipeline::Vec3d unit{column == 0 ? 1.0 : 0.0, column == 1 ? 1.0 : 0.0, column == 2 ? 1.0 : 0.0};
    const pipeline::Vec3d to = apply(turn, apply(upright.right_from_left.rotation, apply(back, unit)));
    double* m = lying.right_from_left.rotation.m + column;
    m[0] = to.x, m[3] = to.y, m[6] = to.z;
  }
  return lying;
}

}  // namespace relievo::test

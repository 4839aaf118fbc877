// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/quality/check_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "pipeline/calibrate/fit/bundle.h"

namespace relievo::pipeline {
namespace {

using Colour = std::array<std::uint8_t, 3>;
constexpr Colour kFirst{255, 60, 60};  // the order starts here
constexpr Colour kCorner{60, 255, 60};
constexpr Colour kLine{255, 200, 0};

Colour pixel(const ImageView& image, int x, int y) {
  const std::uint8_t* row = image.row(y);
  if (image.format == PixelFormat::Rgb8) return {row[3 * x], row[3 * x + 1], row[3 * x + 2]};
  // The upper byte of a little-endian 16 bit pixel is enough for a look.
  const std::uint8_t grey = image.format == PixelFormat::Grey16 ? row[2 * x + 1] : row[x];
  return {grey, grey, grey};
}

void put(CheckPicture& picture, int x, int y, const Colour& colour) {
  if (x < 0 || y < 0 || x >= picture.width_px || y >= picture.height_px) return;
  for (std::size_t c = 0; c < 3; ++c)
    picture.rgb[3 * (std::size_t(y) * std::size_t(picture.width_px) + std::size_t(x)) + c] =
        static_cast<std::byte>(colour[c]);
}

CheckPicture blank(const ImageView& one) {
  CheckPicture picture;
  picture.width_px = 2 * one.width_px;
  picture.height_px = one.height_px;
  picture.rgb.resize(3 * std::size_t(picture.width_px) * std::size_t(picture.height_px));
  return picture;
}

void draw_corners(CheckPicture& picture, const BoardCorners& corners, int offset) {
  const int arm = std::max(4, picture.width_px / 500);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!seen(corners[i])) continue;
    const int x = int(std::lround(corners[i].x));
    const int y = int(std::lround(corners[i].y));
    for (int d = -arm; d <= arm; ++d) {
      put(picture, offset + x + d, y, i == 0 ? kFirst : kCorner);
      put(picture, offset + x, y + d, i == 0 ? kFirst : kCorner);
    }
  }
}

void draw_rectified(CheckPicture& picture, const ImageView& from, const CameraIntrinsics& camera,
                    const Eigen::Matrix3d& camera_from_rectified, double focal, const Eigen::Vector2d& centre,
                    int offset) {
  for (int y = 0; y < from.height_px; ++y)
    for (int x = 0; x < from.width_px; ++x) {
      bundle::Pose ray;
      ray.translation_mm =
          camera_from_rectified * Eigen::Vector3d((x - centre.x()) / focal, (y - centre.y()) / focal, 1);
      if (ray.translation_mm.z() <= 0.1) continue;
      const Vec2d at = bundle::project(camera, ray, 0, 0);
      if (!(at.x >= 0 && at.y >= 0 && at.x <= from.width_px - 1 && at.y <= from.height_px - 1)) continue;
      put(picture, offset + x, y, pixel(from, int(std::lround(at.x)), int(std::lround(at.y))));
    }
}

}  // namespace

CheckPicture corner_picture(const ImageView& left, const BoardCorners& left_corners, const ImageView& right,
                            const BoardCorners& right_corners) {
  CheckPicture picture = blank(left);
  for (int y = 0; y < left.height_px; ++y)
    for (int x = 0; x < left.width_px; ++x) {
      put(picture, x, y, pixel(left, x, y));
      put(picture, left.width_px + x, y, pixel(right, x, y));
    }
  draw_corners(picture, left_corners, 0);
  draw_corners(picture, right_corners, left.width_px);
  return picture;
}

CheckPicture thumbnail_picture(const ImageView& image, int width_px) {
  CheckPicture picture;
  picture.width_px = std::clamp(width_px, 1, image.width_px);
  picture.height_px =
      std::max(1, int(std::lround(double(picture.width_px) * image.height_px / image.width_px)));
  picture.rgb.resize(3 * std::size_t(picture.width_px) * std::size_t(picture.height_px));
  const auto begin = [](int at, int small, int large) { return int(static_cast<long>(at) * large / small); };
  for (int y = 0; y < picture.height_px; ++y)
    for (int x = 0; x < picture.width_px; ++x) {
      const int top = begin(y, picture.height_px, image.height_px);
      const int left = begin(x, picture.width_px, image.width_px);
      const int bottom = std::max(top + 1, begin(y + 1, picture.height_px, image.height_px));
      const int right = std::max(left + 1, begin(x + 1, picture.width_px, image.width_px));
      std::array<long, 3> sum{};
      for (int v = top; v < bottom; ++v)
        for (int u = left; u < right; ++u) {
          const Colour colour = pixel(image, u, v);
          for (std::size_t c = 0; c < 3; ++c) sum[c] += colour[c];
        }
      const long count = static_cast<long>(bottom - top) * (right - left);
      Colour mean{};
      for (std::size_t c = 0; c < 3; ++c) mean[c] = std::uint8_t((sum[c] + count / 2) / count);
      put(picture, x, y, mean);
    }
  return picture;
}

CheckPicture rectified_picture(const ImageView& left, const ImageView& right,
                               const StereoCalibration& calibration) {
  Eigen::Matrix3d right_from_left;
  for (int i = 0; i < 9; ++i) right_from_left(i / 3, i % 3) = calibration.right_from_left.rotation.m[i];
  const Vec3d& t = calibration.right_from_left.translation_mm;
  const Eigen::Vector3d along = (right_from_left.transpose() * -Eigen::Vector3d(t.x, t.y, t.z)).normalized();
  const Eigen::Vector3d ahead = Eigen::Vector3d(0, 0, 1) + right_from_left.transpose().col(2);
  Eigen::Matrix3d left_from_rectified;
  left_from_rectified.col(0) = along;
  left_from_rectified.col(1) = ahead.cross(along).normalized();
  left_from_rectified.col(2) = along.cross(left_from_rectified.col(1));
  const Eigen::Matrix3d right_from_rectified = right_from_left * left_from_rectified;
  const double focal = 0.25 * (calibration.left.focal_px.x + calibration.left.focal_px.y +
                               calibration.right.focal_px.x + calibration.right.focal_px.y);
  // Each window is laid so that its camera's axis stands in the middle; rows are common to both.
  const Eigen::Vector3d left_axis = left_from_rectified.transpose().col(2);
  const Eigen::Vector3d right_axis = right_from_rectified.transpose().col(2);
  const double middle_y =
      0.5 * left.height_px - 0.5 * focal * (left_axis.y() / left_axis.z() + right_axis.y() / right_axis.z());
  CheckPicture picture = blank(left);
  draw_rectified(picture, left, calibration.left, left_from_rectified, focal,
                 {0.5 * left.width_px - focal * left_axis.x() / left_axis.z(), middle_y}, 0);
  draw_rectified(picture, right, calibration.right, right_from_rectified, focal,
                 {0.5 * left.width_px - focal * right_axis.x() / right_axis.z(), middle_y}, left.width_px);
  const int step = std::max(8, picture.height_px / 24);
  for (int y = step / 2; y < picture.height_px; y += step)
    for (int x = 0; x < picture.width_px; ++x) put(picture, x, y, kLine);
  return picture;
}

}  // namespace relievo::pipeline

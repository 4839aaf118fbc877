// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/calibrate/check_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory_resource>

#include "pipeline/match/rectify/rectifier.h"

namespace relievo::firmware {
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

void put(hal::Picture& picture, int x, int y, const Colour& colour) {
  if (x < 0 || y < 0 || x >= picture.width_px || y >= picture.height_px) return;
  for (std::size_t c = 0; c < 3; ++c)
    picture.bytes[3 * (std::size_t(y) * std::size_t(picture.width_px) + std::size_t(x)) + c] =
        static_cast<std::byte>(colour[c]);
}

hal::Picture blank(const ImageView& one) {
  hal::Picture picture{{}, 2 * one.width_px, one.height_px, PixelFormat::Rgb8};
  picture.bytes.resize(3 * std::size_t(picture.width_px) * std::size_t(picture.height_px));
  return picture;
}

void draw_corners(hal::Picture& picture, const pipeline::BoardCorners& corners, int offset) {
  const int arm = std::max(4, picture.width_px / 500);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!pipeline::seen(corners[i])) continue;
    const int x = int(std::lround(corners[i].x));
    const int y = int(std::lround(corners[i].y));
    for (int d = -arm; d <= arm; ++d) {
      put(picture, offset + x + d, y, i == 0 ? kFirst : kCorner);
      put(picture, offset + x, y + d, i == 0 ? kFirst : kCorner);
    }
  }
}

}  // namespace

hal::Picture corner_picture(const ImageView& left, const pipeline::BoardCorners& left_corners,
                            const ImageView& right, const pipeline::BoardCorners& right_corners) {
  hal::Picture picture = blank(left);
  for (int y = 0; y < left.height_px; ++y)
    for (int x = 0; x < left.width_px; ++x) {
      put(picture, x, y, pixel(left, x, y));
      put(picture, left.width_px + x, y, pixel(right, x, y));
    }
  draw_corners(picture, left_corners, 0);
  draw_corners(picture, right_corners, left.width_px);
  return picture;
}

Result<hal::Picture> rectified_picture(const ImageView& left, const ImageView& right,
                                       const pipeline::StereoCalibration& calibration) {
  pipeline::RectifiedPair pair(std::pmr::null_memory_resource());  // geometry only
  pipeline::RectifierOptions any_size;
  any_size.longest_side_px = 1 << 20;  // no more is drawn than a view is large
  RELIEVO_TRY(pipeline::lay_windows(calibration, any_size, pair));
  hal::Picture picture = blank(left);
  const auto draw = [&](const ImageView& from, const pipeline::CameraIntrinsics& camera,
                        const pipeline::Rotation& turn, const pipeline::Vec2d& centre, int offset) {
    // The middle of the window.
    const double across = 0.5 * (pair.width_px - from.width_px),
                 down = 0.5 * (pair.height_px - from.height_px);
    for (int y = 0; y < from.height_px; ++y)
      for (int x = 0; x < from.width_px; ++x) {
        const pipeline::Vec2d at =
            pipeline::source_pixel(camera, turn, pair.focal_px, centre, {x + across, y + down});
        if (!(at.x >= 0 && at.y >= 0 && at.x <= from.width_px - 1 && at.y <= from.height_px - 1)) continue;
        put(picture, offset + x, y, pixel(from, int(std::lround(at.x)), int(std::lround(at.y))));
      }
  };
  draw(left, calibration.left, pair.rectified_from_left, pair.left_centre_px, 0);
  draw(right, calibration.right, pair.rectified_from_right, pair.right_centre_px, left.width_px);
  const int step = std::max(8, picture.height_px / 24);
  for (int y = step / 2; y < picture.height_px; y += step)
    for (int x = 0; x < picture.width_px; ++x) put(picture, x, y, kLine);
  return picture;
}

}  // namespace relievo::firmware

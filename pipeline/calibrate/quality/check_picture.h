// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures by which a person checks a calibration: the corners found, and the rectified pair with
// lines across both views, on which the same point must lie, left and right side by side; and a small
// one of a single view. RGB.
// Thread: any. Errors: none; sizes are the caller's promise.
#pragma once

#include <cstddef>
#include <vector>

#include "hal/base/image_view.h"
#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/model/calibration.h"

namespace relievo::pipeline {

struct CheckPicture {
  std::vector<std::byte> rgb;
  int width_px = 0;
  int height_px = 0;

  ImageView view() const { return {rgb.data(), width_px, height_px, 3 * width_px, PixelFormat::Rgb8}; }
};

// Both views must be as large as each other. Corners may be empty.
CheckPicture corner_picture(const ImageView& left, const BoardCorners& left_corners, const ImageView& right,
                            const BoardCorners& right_corners);

// At most as wide as said, each pixel the mean of those it stands for.
CheckPicture thumbnail_picture(const ImageView& image, int width_px);

// Both views must have the calibration's size.
CheckPicture rectified_picture(const ImageView& left, const ImageView& right,
                               const StereoCalibration& calibration);

}  // namespace relievo::pipeline

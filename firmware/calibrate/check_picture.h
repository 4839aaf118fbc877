// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures by which a person checks a calibration: the corners found, and the rectified pair with lines
// across both views, on which the same point must lie; left and right side by side. Both views must have the
// calibration's size. Thread: any.
#pragma once

#include "hal/picture_file.h"
#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/model/calibration.h"

namespace relievo::firmware {

// Corners may be empty.
hal::Picture corner_picture(const ImageView& left, const pipeline::BoardCorners& left_corners,
                            const ImageView& right, const pipeline::BoardCorners& right_corners);

// Errors: InvalidInput (the cameras do not look at a common volume).
Result<hal::Picture> rectified_picture(const ImageView& left, const ImageView& right,
                                       const pipeline::StereoCalibration& calibration);

}  // namespace relievo::firmware

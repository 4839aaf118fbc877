// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Resamples both pictures so that corresponding points share a row.
//
// The common x axis is the baseline; the common z axis lies between the two optical axes. Scale is
// the cameras' own: the windows are laid over the pictures, one each, so that a toed-in pair is
// neither zoomed nor cut (cf. Fusiello, Trucco, Verri 2000 for the rotation). Luminance is resampled
// by cubic convolution (Keys 1981, a = -1/2), colour linearly.
// Memory: the pair in `output`; scratch holds one grey source plane.
// Errors: InvalidInput (empty picture, rows that overlap, size other than calibrated, impossible geometry),
// OutOfMemory, Cancelled. Thread: any; holds no state between calls.
#pragma once

#include "hal/base/image_view.h"
#include "hal/base/result.h"
#include "pipeline/base/stage.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/model/stereo_frame.h"

namespace relievo::pipeline {

// Grey values 0 to 255 of a picture's row, whatever its format: 16 bit scaled down, colour as the mean of
// its channels, the least noise for texture that all three share. Thread: any.
void grey_row(const ImageView& image, int y, float* to);

struct RectifierOptions {
  double near_mm = 400;  // the volume in which a surface is looked for, along the rectified z axis
  double far_mm = 750;
  int longest_side_px = 4096;  // refuse geometry that needs a larger window: the rig cannot see the volume
  Result<void> check() const;
  Result<RectifiedPair> rectify(const StereoFrame& frame, const StereoCalibration& calibration,
                                StageContext& context) const;
};

// Where the rectified windows lie: fills everything of `pair` but the pixels. Errors: InvalidInput (the
// cameras do not look at a common volume, or the window would be larger than allowed).
Result<void> lay_windows(const StereoCalibration& calibration, const RectifierOptions& options,
                         RectifiedPair& pair);

// The picture pixel that sees what the window pixel `at` of this view shows.
Vec2d source_pixel(const CameraIntrinsics& camera, const Rotation& rectified_from_camera, double focal_px,
                   Vec2d centre_px, Vec2d at);

// Two pictures that are rectified already, as benchmarks give them: taken as they are, pixel for pixel. No
// rig is known: a nominal one stands in for algorithms that think in millimetres, so that disparities of the
// range lie between `near_mm` and `far_mm`. Depths in millimetres then mean nothing; disparities do.
// Memory: the pair in `output`. Errors: InvalidInput (empty, sizes that differ, an empty range), Cancelled.
struct DisparityRange {
  int least_px = 0;
  int most_px = 256;  // not reached
  Result<void> check() const;
};

Result<RectifiedPair> take_rectified(const StereoFrame& frame, const DisparityRange& range,
                                     StageContext& context);

}  // namespace relievo::pipeline

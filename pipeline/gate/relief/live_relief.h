// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LiveRelief: metric depth of the whole scene from the live pair, more than ten times a second: both pictures
// made smaller, rectified, matched by semi-global matching from a sixteenth of the size down to `reduction`
// (match/coarse), freed of specks, and cut into connected surfaces.
//
// Promise: memory depends on the size of the pictures only and is the context's; results are bit-identical
// for any number of threads. Depth is along the rectified z axis. One step of disparity is z^2 / (focal_px *
// baseline_mm): 3 mm at 560 mm on the rig of hal/sim; what is read between steps is better. Memory: the
// relief in context.output, everything else in context.scratch. Thread: worker. Errors: InvalidInput
// (options, empty picture, size other than calibrated), OutOfMemory, Cancelled.
#pragma once

#include <cstdint>

#include "hal/base/image_view.h"
#include "pipeline/base/stage.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/relief.h"
#include "pipeline/model/stereo_frame.h"

namespace relievo::pipeline {

// The relief as grey values to look at: near is bright (255 at near_mm, 40 at far_mm, even steps of
// disparity), 0 is unknown. `grey`: width_px * height_px values, row by row without padding.
void draw_relief(const Relief& relief, double near_mm, double far_mm, std::uint8_t* grey);

// A picture at a fraction of its size, each pixel the mean of a square of the larger's, and the calibration
// that belongs to it: the same format; what is left of a row or column that no whole square covers is
// dropped. factor 1 hands `image` back. Memory: context.scratch. Throws std::bad_alloc as every stage does.
ImageView reduced(const ImageView& image, int factor, StageContext& context);
StereoCalibration reduced(const StereoCalibration& calibration, int factor);

struct LiveRelief {
  static constexpr double kNearMm = 280, kFarMm = 1100;  // the volume that is looked at
  int reduction = 4;  // the pictures are made smaller so often; 1: they are small already
  Result<void> check() const;
  Result<Relief> look(const StereoFrame& frame, const StereoCalibration& calibration,
                      StageContext& context) const;
};

// Labels connected pixels of one surface (4-neighbours whose disparities differ by little), the largest
// first, and takes away what is small as seen from the camera. Fills relief.surface. Memory: scratch.
void label_surfaces(Relief& relief, StageContext& context);

}  // namespace relievo::pipeline

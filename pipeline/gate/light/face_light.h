// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How well a face is lit. The measures are those of ISO/IEC 29794-5 as its reference implementation (OFIQ)
// computes them, where it says so: named by its component. Luminance is the mean of the channels, 0 .. 255,
// of the small picture; the face is the ellipse about the nose, upright with the head, that the relief knows
// and nothing stands before. Memory: none of its own. Thread: any. Errors: none.
#pragma once

#include "pipeline/gate/head/head_measurement.h"

namespace relievo::pipeline {

struct FaceLight {
  bool known = false;
  double luminance_mean = 0;      // 0 .. 1                                             LuminanceMean
  double luminance_variance = 0;  // of luminance 0 .. 1                                LuminanceVariance
  double dark_share = 0;    // of the face, luminance 0 .. 25                     UnderExposurePrevention
  double bright_share = 0;  // 247 .. 255                                         OverExposurePrevention
  double entropy_bits = 0;  // of the histogram, 0 .. 8                           DynamicRange
  double uniformity = 1;    // what histograms of both cheeks share, 0 .. 1       IlluminationUniformity
  double side_ratio =
      1;  // mean luminance of the darker cheek, share of the brighter's: the same fault, graded
  double glossy_share = 0;  // much brighter than the skin about it
};

FaceLight measure_light(const Relief& relief, const HeadMeasurement& head);

}  // namespace relievo::pipeline

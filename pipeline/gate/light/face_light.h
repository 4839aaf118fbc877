// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How well a face is lit. The measures are those of ISO/IEC 29794-5 as its reference implementation (OFIQ)
// computes them, where it says so: named by its component. Luminance is the mean of the channels, 0 .. 255,
// of the small picture; the face is the ellipse about the nose, upright with the head, that the relief knows
// and nothing stands before. Memory: none of its own. Thread: any. Errors: none.
#pragma once

#include "pipeline/base/stage.h"
#include "pipeline/gate/head/head_measurement.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/stereo_frame.h"

namespace relievo::pipeline {

struct FaceLight {
  bool known = false;
  double luminance_mean = 0;  // 0 .. 1                                             LuminanceMean
  double dark_share = 0;      // of the face, luminance 0 .. 25                     UnderExposurePrevention
  double bright_share = 0;    // 247 .. 255                                         OverExposurePrevention
  double side_ratio = 1;      // mean luminance of the darker cheek, share of the brighter's
  double glossy_share = 0;    // much brighter than the skin about it
};

FaceLight measure_light(const Relief& relief, const HeadMeasurement& head);

// How blurred a face is, in millimetres on the face, whoever's it is: from how much its edges lose when they
// are blurred once more by a known width (after Zhuo and Sim, Defocus map estimation from a single image,
// Pattern Recognition 44, 2011). Contrast cancels out; what noise adds is measured on the flattest part of
// the face and taken off. Memory: scratch; deterministic.
// Deviation of the bell that blurs the sharpest edges between brows and mouth, the more blurred direction of
// the more blurred camera, in the pictures at full size: lens, focus, fog, motion, and the pixels themselves.
// At most kMostBlurMm, which is also said where no edge is left.
double measure_blur_mm(const StereoFrame& frame, const StereoCalibration& calibration, const Relief& relief,
                       const HeadMeasurement& head, StageContext& context);

inline constexpr double kMostBlurMm = 6;

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the rectified windows lie and which source pixel each of their pixels comes from.
#pragma once

#include "hal/base/result.h"
#include "pipeline/match/rectify/rectifier.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// Fills everything of `pair` but the pixels. Errors: InvalidInput (the cameras do not look at a
// common volume, or the window would be larger than allowed).
Result<void> lay_windows(const StereoCalibration& calibration, const RectifierOptions& options,
                         RectifiedPair& pair);

// The picture pixel that sees what the window pixel `at` of this view shows.
Vec2d source_pixel(const CameraIntrinsics& camera, const Rotation& rectified_from_camera, double focal_px,
                   Vec2d centre_px, Vec2d at);

}  // namespace relievo::pipeline

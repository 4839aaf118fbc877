// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A picture at a fraction of its size, each pixel the mean of a square of the larger's, and the calibration
// that belongs to it. Memory: context.scratch. Thread: worker. Errors: none; throws std::bad_alloc as every
// stage does.
#pragma once

#include "hal/base/image_view.h"
#include "pipeline/base/stage.h"
#include "pipeline/model/calibration.h"

namespace relievo::pipeline {

// The same format; what is left of a row or column that no whole square covers is dropped. factor 1 hands
// `image` back.
ImageView reduced(const ImageView& image, int factor, StageContext& context);

// Of pictures made smaller by reduced().
StereoCalibration reduced(const StereoCalibration& calibration, int factor);

}  // namespace relievo::pipeline

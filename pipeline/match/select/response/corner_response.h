// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Corners by the structure tensor (the mean over a window of the gradient's products): what the two
// corner selectors share. Gradients are Sobel's, in grey levels a pixel.
// Memory: four planes of the picture's size in `scratch` while it works. Thread: any; bands on the pool.
#pragma once

#include <memory_resource>
#include <vector>

#include "pipeline/base/stage.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/match/select/response/keypoint_choice.h"

namespace relievo::pipeline {

struct CornerWindow {
  int radius_px = 3;
  int passes = 1;  // 1: a square, each pixel counts the same; 3: close to a Gaussian
  // How far from its centre a response looks, gradients included.
  int reach_px() const { return radius_px * passes + 1; }
};

// The tensor's entries at a pixel become the response.
using CornerMeasure = float (*)(float xx, float xy, float yy, float parameter);
float smaller_eigenvalue(float xx, float xy, float yy, float);          // Shi and Tomasi 1994
float harris_measure(float xx, float xy, float yy, float sensitivity);  // Harris and Stephens 1988

// Fills `response`: 0 where nothing may be selected and where the measure is negative. False: cancelled.
bool corner_response(const std::pmr::vector<float>& grey, const Selectable& selectable,
                     const CornerWindow& window, CornerMeasure measure, float parameter,
                     StageContext& context, Plane<float>& response);

}  // namespace relievo::pipeline

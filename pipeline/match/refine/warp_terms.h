// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The data terms of SurfaceRefiner: the right view warped onto the left by a disparity field, and
// what every pixel then says about the field.
#pragma once

#include "pipeline/match/refine/surface_refiner.h"

namespace relievo::pipeline {

// A rectangle of level pixels that surrounds the surface.
struct Window {
  int x0 = 0, y0 = 0, width = 0, height = 0;
};

// Per pixel of the window, 0 where the pixel says nothing.
struct WarpTerms {
  WarpTerms(std::pmr::memory_resource* memory, int width, int height) : shape{memory, width, height} {}
  PlaneShape shape;
  Plane<float> residual{shape};  // grey levels, offset and gain removed
  Plane<float> gradient{shape};  // its derivative by the disparity, grey levels per full-size pixel
  Plane<float> weight{shape};    // 1 / variance of the residual
  Plane<float> mask{shape};      // 1 where both views show the surface
  Plane<float> cost{shape};      // 1 - local zero-mean normalised correlation
  float noise_variance = 0;      // of the residual over the whole surface
};

// `agreed`, where wanted: the product of both views' own derivatives by the disparity, means taken out. Its
// mean is that of the squared gradient without noise, for the noise of the views is independent.
void form_terms(const RefinerScene& scene, const SurfaceRefinerOptions& options, const SurfaceField& field,
                const Window& window, StageContext& context, WarpTerms& terms, Plane<float>* agreed);

}  // namespace relievo::pipeline

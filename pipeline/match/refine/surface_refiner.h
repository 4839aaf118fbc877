// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SurfaceRefiner: turns a rough disparity field into one at the accuracy the image noise allows.
//
// One image is warped by the current field, every pixel's residual and gradient are formed
// symmetrically in both views (Nehab et al. 2005; the one-sided bias cancels), local offset and gain
// are taken out, and one linear system for the whole face is solved by conjugate gradients:
//
//   E(d) = sum w (residual + gradient * delta)^2 + lambda * sum omega |second differences of d|^2
//
// so the effective window grows where the skin is plain and shrinks where it is rich, and a curved
// surface is not pulled flat (second order: planes cost nothing). omega falls where the surface bends
// sharply (iteratively reweighted, bending_system.h), so that eyelids and nostrils keep their creases, lips
// their wrinkles. sigma is the posterior of that system: sigma^2 = 1 / (8 sqrt(A lambda omega)), the closed
// form of the integral of 1 / (A + lambda k^4) over the plane, times what the residuals' correlation adds.
// Memory: scratch only. Results do not depend on the number of threads.
#pragma once

#include <cstdint>

#include "hal/base/thread_pool.h"
#include "pipeline/base/stage.h"
#include "pipeline/match/bending/bending_system.h"
#include "pipeline/match/image/image_pyramid.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/match/image/surface_field.h"

namespace relievo::pipeline {

// How much more than white noise the pictures' disagreement shakes SurfaceRefiner's fit. Residuals hang
// together from pixel to pixel: resampling spreads them, highlights and shading that the gain does not
// explain are patches. A covariance that takes them for independent is too small there; the variance of
// what they really pull, summed over blocks as wide as the fit's reach, tells by how much (the "sandwich"
// of White 1980, in space Conley 1999).

// Share of what seems to be information that at least is: a smaller estimate is lost in its own noise.
inline constexpr float kLeastReal = 0.06F;

// `pull` is the weighted gradient times residual gathered at every node, from tents of `step` pixels (1 or 2)
// on each side. Writes the factor of the variance, 1 where the residuals look independent and where nothing
// was measured; never below a half. `real`: the part of system.data without noise. `excess`: as large.
void measure_score_excess(const BendingSystem& system, const Plane<float>& pull, const Plane<float>& real,
                          int step, ThreadPool& pool, std::pmr::memory_resource& scratch,
                          Plane<float>& excess);

struct WarpTerms;  // warp_terms.h

// How much less the pixels say than as many independent ones would: noise that hangs together from pixel to
// pixel (interpolated colours, compression) shakes the fit by the sum over all shifts of the residual's and
// the gradient's autocorrelation. 1 for a sensor's own pixels, about 3 for photographs stored as JPEG. What
// the fit has not followed yet is small beside the noise, pixel by pixel. Thread: one caller.
float hanging_noise(const WarpTerms& terms, ThreadPool& pool);

struct SurfaceRefinerOptions {
  float bending = 0.17F;       // expected roughness: root of the spectral density of curvature, dimensionless
  float crease = 0.9F;         // second differences beyond this many expected ones count as creases
  float wrinkle = 0.135F;      // at full size, patches that bend well beyond this many expected ones count as
                               // relief; 0: none do
  int local_window_px = 13;    // offset and gain are constant over this window, full-size pixels
  int smallest_window_px = 9;  // and at least this many pixels of a smaller level
  int steps = 5;               // warps at full size; one less at half, twice that at a quarter of it
  int solver_steps = 60;       // conjugate-gradient steps a warp
};

struct RefinerScene {
  const Plane<float>& left;
  const Plane<float>& right;
  const Plane<std::uint8_t>& right_valid;
  int level;         // the pictures are 2^level smaller than full size
  double lambda_px;  // weight of squared second derivatives per full-size pixel
};

Result<void> refine_surface(const RefinerScene& scene, const SurfaceRefinerOptions& options,
                            StageContext& context, SurfaceField& field);

}  // namespace relievo::pipeline

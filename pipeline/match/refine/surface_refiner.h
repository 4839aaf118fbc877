// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// refine_surface() turns a rough disparity field into one at the accuracy the image noise allows.
//
// One image is warped by the current field, every pixel's residual and gradient are formed
// symmetrically in both views (Nehab et al. 2005; the one-sided bias cancels), local offset and gain
// are taken out, and one linear system for the whole face is solved by conjugate gradients:
//
//   E(d) = sum w (residual + gradient * delta)^2 + lambda * sum omega |second differences of d|^2
//
// so the effective window grows where the skin is plain and shrinks where it is rich, and a curved surface is
// not pulled flat (second order: planes cost nothing). omega falls where the surface bends sharply
// (iteratively reweighted, bending_system.h), so that eyelids and nostrils keep their creases, lips their
// wrinkles. sigma is the posterior of that system: sigma^2 = 1 / (8 sqrt(A lambda omega)), the closed form of
// the integral of 1 / (A + lambda k^4) over the plane, times what the residuals' correlation adds, and what
// uneven light does (misread_px). Memory: scratch only. Results do not depend on the number of threads.
#pragma once

#include <cstdint>

#include "hal/base/thread_pool.h"
#include "pipeline/base/stage.h"
#include "pipeline/match/bending/bending_system.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/match/image/plane_filters.h"

namespace relievo::pipeline {

// How much more than white noise the pictures' disagreement shakes its fit. Residuals hang
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

// Skin that shines, lips most of all, is not lit alike for both cameras. Where the ratio of their grey values
// is even, offset and gain take it out; where it changes from one place to the next, it is taken for detail
// that has moved, and all pixels around are misled one way: no residual shows that. By how much: the scatter
// of the ratio as a share of it, over 7 x 7 nodes, divided by the share by which skin's grey values change
// from one pixel to the next: a 15th. `ratio` and `in`, 1 where it is known, are planes of nodes; the result
// goes to `ratio`, pixels. `scratch`: three such planes.
void misread_px(const Plane<float>& in, ThreadPool& pool, std::pmr::memory_resource& scratch,
                Plane<float>& ratio);

// The data terms: the right view warped onto the left by a disparity field, and what every pixel then says
// about the field.

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
};

// How much less the pixels say than as many independent ones would: noise that hangs together from pixel to
// pixel (interpolated colours, compression) shakes the fit by the sum over all shifts of the residual's and
// the gradient's autocorrelation. 1 for a sensor's own pixels, about 3 for photographs stored as JPEG. What
// the fit has not followed yet is small beside the noise, pixel by pixel. Thread: one caller.
float hanging_noise(const WarpTerms& terms, ThreadPool& pool);

struct SurfaceRefinerOptions {
  float bending = 0.17F;     // expected roughness: root of the spectral density of curvature, dimensionless
  float crease = 0.9F;       // second differences beyond this many expected ones count as creases
  float wrinkle = 0.135F;    // at full size, patches that bend well beyond this many expected ones count as
                             // relief; 0: none do
  int local_window_px = 13;  // offset and gain are constant over this window, full-size pixels
  int steps = 5;             // warps at full size; one less at half, twice that at a quarter of it
  int solver_steps = 60;     // conjugate-gradient steps a warp
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

// What sigma needs besides, per pixel.
struct SigmaTerms {
  explicit SigmaTerms(const PlaneShape& shape) : agreed(shape), ratio(shape) {}
  // The product of both views' own derivatives by the disparity, means taken out. Its mean is that of the
  // squared gradient without noise, for the noise of the views is independent.
  Plane<float> agreed;
  Plane<float> ratio;  // of the right view's mean grey to the left one's, over the window for offset and gain
};

// `for_sigma` where it is wanted.
void form_terms(const RefinerScene& scene, const SurfaceRefinerOptions& options, const SurfaceField& field,
                const Window& window, StageContext& context, WarpTerms& terms, SigmaTerms* for_sigma);

// Where the left view shows dark lines, 16 nodes of them and hardly wider than six: between closed lips,
// under a lid, along a wrinkle. Skin folds there, or may: the prior lets it, the views say whether it does.
// The window's nodes are `step` pixels apart. Memory: scratch only. Results do not depend on the number of
// threads.
void find_dark_lines(const RefinerScene& scene, const Window& nodes, int step, StageContext& context,
                     Folds& folds);

// Looks for the surface once more by its fine detail. A highlight lies at another depth than the skin it
// shines on, and on dark or even skin it is all that a small picture shows: the coarse matching follows it,
// by several pixels at the tip of a nose, too far for refinement to find back. Pores do not: of both views
// only what is finer than a few pixels is kept, and where that agrees clearly better some pixels to the
// side, correlated over a window that is still smaller than a nose, the field is moved there.
// Memory: scratch only. Results do not depend on the number of threads. Thread: any.
//
// Moves field.disparity_px where another place is clearly better, and says whether it did. The field's nodes
// must be the scene's pixels.
bool search_by_detail(const RefinerScene& scene, StageContext& context, SurfaceField& field);

// Cuts the field along occluding contours: where the left view looks past the edge of a near surface, the
// ridge of a nose, at a far one, a smooth field hangs a curtain from the one to the other. The curtain is
// steeper than skin that can be matched, it drags both surfaces along, and it holds itself up: half of its
// pixels agree with either. Both surfaces are continued under it, and each row is cut where the views agree
// best with the near one to the left and the far one to the right (no ordering is broken: the right view sees
// both, and more between them). Curtains that rise to the right hide the far surface from the right view:
// cross-check and uniqueness deal with them. Where a contour lies across, a chin before its throat, columns
// are cut the same way. Memory: scratch only. Results do not depend on the number of threads.
//
// `field` has a node on every pixel of the scene's level; its domain stays. How many rows and columns were
// cut.
int cut_at_occluding_contours(const RefinerScene& scene, StageContext& context, SurfaceField& field);

}  // namespace relievo::pipeline

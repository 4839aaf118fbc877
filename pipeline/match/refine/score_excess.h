// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How much more than white noise the pictures' disagreement shakes SurfaceRefiner's fit. Residuals hang
// together from pixel to pixel: resampling spreads them, highlights and shading that the gain does not
// explain are patches. A covariance that takes them for independent is too small there; the variance of
// what they really pull, summed over blocks as wide as the fit's reach, tells by how much (the "sandwich"
// of White 1980, in space Conley 1999).
// Memory: scratch only. Results do not depend on the number of threads. Thread: any.
#pragma once

#include "pipeline/match/bending/bending_system.h"

namespace relievo::pipeline {

// Share of what seems to be information that at least is: a smaller estimate is lost in its own noise.
inline constexpr float kLeastReal = 0.06F;

// `pull` is the weighted gradient times residual gathered at every node, from tents of `step` pixels (1 or 2)
// on each side. Writes the factor of the variance, 1 where the residuals look independent and where nothing
// was measured; never below a half. `real` is the part of system.data that holds no noise. `excess` has the
// system's shape.
void measure_score_excess(const BendingSystem& system, const Plane<float>& pull, const Plane<float>& real,
                          int step, ThreadPool& pool, std::pmr::memory_resource& scratch,
                          Plane<float>& excess);

}  // namespace relievo::pipeline

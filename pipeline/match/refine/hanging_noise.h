// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Noise that hangs together from pixel to pixel. Thread: one caller.
#pragma once

#include "hal/base/thread_pool.h"
#include "pipeline/match/refine/warp_terms.h"

namespace relievo::pipeline {

// How much less the pixels say than as many independent ones would: noise that hangs together from pixel to
// pixel (interpolated colours, compression) shakes the fit by the sum over all shifts of the residual's and
// the gradient's autocorrelation. 1 for a sensor's own pixels, about 3 for photographs stored as JPEG. What
// the fit has not followed yet is no part of it: it is small beside the noise, pixel by pixel.
float hanging_noise(const WarpTerms& terms, ThreadPool& pool);

}  // namespace relievo::pipeline

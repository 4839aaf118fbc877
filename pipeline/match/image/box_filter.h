// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sums over a square window, by running sums: the cost does not depend on the window.
#pragma once

#include "hal/base/thread_pool.h"
#include "pipeline/match/image/plane.h"

namespace relievo::pipeline {

// to(x, y) = sum of from over |dx|, |dy| <= radius, with 0 outside; from and to may be the same plane.
// `across` is scratch of the same size.
void box_sum(const Plane<float>& from, int radius, ThreadPool& pool, Plane<float>& across, Plane<float>& to);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A thin plate over a globe: continues values that are known on a part of it, with their slope, and returns
// to zero some 40 mm further on (least squares: squared Laplacians, nearness to the known, smallness
// elsewhere). The values are what is added to a shape, and together they are the surface: beside the known
// part that as a whole goes on without a bend, and over 50 mm it comes to bend as the shape does. Known
// values further than 12 mm inside their part do not count. Memory: the heap, for the sparse factorisation.
// Thread: any; deterministic.
#pragma once

#include <span>

#include "pipeline/mesh/completion/globe.h"

namespace relievo::pipeline {

// `shape`, `value`: one a node; values that are NaN are not known and are set. `step_mm`: from node to node.
void continue_over_globe(const Globe& globe, double step_mm, std::span<const double> shape,
                         std::span<double> value);

}  // namespace relievo::pipeline

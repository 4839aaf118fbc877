// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A thin plate over a globe: continues values that are known on a part of it, with their slope, and returns
// to zero some 30 mm further on (least squares: squared Laplacians, nearness to the known, smallness
// elsewhere). Known values further than 12 mm inside their part do not count. Memory: the heap, for the
// sparse factorisation. Thread: any; deterministic.
#pragma once

#include <span>

#include "pipeline/mesh/completion/globe.h"

namespace relievo::pipeline {

// `value`: one a node, NaN where it is not known; those are set. `step_mm`: from node to node.
void continue_over_globe(const Globe& globe, double step_mm, std::span<double> value);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every board under the final fit: where it stood, and by how much each of its corners is missed. A pair
// that was used stands in one place for both cameras; of a pair left out each camera has its own.
// Pixels; frames: left camera, millimetres. Thread: any.
#pragma once

#include <vector>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct StereoFit;

// Not-a-number where the corner was not seen, or was dropped as a stray.
struct CornerResidual {
  Vec2d at;   // where it was seen
  Vec2d off;  // from where the fit puts it
};

struct FittedView {
  bool placed = false;               // false: took no part in the fit
  RigidTransform left_from_board;    // as the left camera has it, where both disagree
  std::vector<CornerResidual> left;  // in the pattern's order; empty where the camera's board took no part
  std::vector<CornerResidual> right;
};

// One for each of `count` views of the input.
std::vector<FittedView> fitted_views(std::size_t count, const StereoFit& fit);

}  // namespace relievo::pipeline

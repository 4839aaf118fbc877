// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closes a face on its head's chart (head_chart.h): everything within its outline (outline_cut.h) that was
// not measured gets a surface that continues what was, as curved as the mirrored other side where that was
// measured (cell_filler.h). Beside a nose, under it, in corners of eyes and mouth, beyond what both cameras
// saw of a cheek. Measured surface stays where it is, but for the steep last two millimetres before a hole
// and what is most unsure below the tip of the nose, which are laid anew.
#pragma once

#include <optional>

#include "pipeline/base/stage.h"
#include "pipeline/mesh/lattice/lattice_resampler.h"
#include "pipeline/mesh/lattice/outline_cut.h"

namespace relievo::pipeline {

// Of what was completed, to a ray from the chart's centre: tangent of 88 degrees.
inline constexpr float kSteepest = 28.6F;

struct ClosedFace {
  ShapedLattice shaped;  // on the chart; in scratch
  FaceOutline outline;
};

// `seen`: the left view's lattice. None where no head is found in it. Errors: Cancelled; throws
// std::bad_alloc.
Result<std::optional<ClosedFace>> close_face(const PointLattice& seen, const Vec3d& right_camera_mm,
                                             const LatticeLimits& limits, StageContext& context);

}  // namespace relievo::pipeline

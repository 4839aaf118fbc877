// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The outline that every face is cut to, a closed curve in the head's frame: where an ellipsoid around the
// tip of the nose meets the skin, along the hairline and before the ears, and along the jaw below the chin,
// whose height follows the person's. It knows nothing of where a picture's measurements end: what they do not
// reach is left to the edge of what was measured. Thread: any.
#pragma once

#include "pipeline/mesh/lattice/head_chart.h"

namespace relievo::pipeline {

struct FaceOutline {
  HeadChart chart;
  double below_mm = 82;  // of the tip of the nose, on the plane of symmetry

  // How far inside the curve a point lies, about in mm near it; negative outside.
  float depth_mm(const Vec3f& from_chart_centre_mm) const;
};

}  // namespace relievo::pipeline

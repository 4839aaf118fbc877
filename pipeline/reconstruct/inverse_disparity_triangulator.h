// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// InverseDisparityTriangulator ("inverse-disparity", the default): on a rectified pair the two lines
// of sight meet exactly, and depth is focal length times baseline over disparity. The standard
// deviation along the line of sight follows: sigma_z = z^2 / (f B) * sigma_d.
#pragma once

#include "pipeline/reconstruct/kinds.h"

namespace relievo::pipeline {

struct InverseDisparityTriangulator {
  Result<PointCloud> triangulate(const RectifiedPair& pair, const MatchSet& matches,
                                 StageContext& context) const;
};

}  // namespace relievo::pipeline

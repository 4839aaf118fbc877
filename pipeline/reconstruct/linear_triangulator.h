// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LinearTriangulator ("linear-least-squares"): the dissertation's reconstruction (Bardsley 2004, ch. 9).
// A point and its two depths are five unknowns; the two lines of sight give six equations:
//   P - s_l * r_l = 0,   P - s_r * r_r = c   (r: ray directions, c: the right camera's centre).
// Solving for P by least squares gives the point nearest to both lines. On exactly rectified matches
// it equals inverse-disparity; it differs where matches come from elsewhere.
#pragma once

#include "pipeline/reconstruct/kinds.h"

namespace relievo::pipeline {

struct LinearTriangulator {
  Result<PointCloud> triangulate(const RectifiedPair& pair, const MatchSet& matches,
                                 StageContext& context) const;
};

}  // namespace relievo::pipeline

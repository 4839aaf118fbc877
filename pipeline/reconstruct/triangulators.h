// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangulators. A point between the volume's near and far limits becomes one of the cloud.
#pragma once

#include "pipeline/base/kinds.h"

namespace relievo::pipeline {

// InverseDisparityTriangulator ("inverse-disparity", the default): on a rectified pair the two lines
// of sight meet exactly, and depth is focal length times baseline over disparity. The standard
// deviation along the line of sight follows: sigma_z = z^2 / (f B) * sigma_d.
struct InverseDisparityTriangulator {
  Result<PointCloud> triangulate(const RectifiedPair& pair, const MatchSet& matches,
                                 StageContext& context) const;
};

// LinearTriangulator ("linear-least-squares"): the dissertation's reconstruction (Bardsley 2004, ch. 9).
// A point and its two depths are five unknowns; the two lines of sight give six equations:
//   P - s_l * r_l = 0,   P - s_r * r_r = c   (r: ray directions, c: the right camera's centre).
// Solving for P by least squares gives the point nearest to both lines. On exactly rectified matches
// it equals inverse-disparity; it differs where matches come from elsewhere.
struct LinearTriangulator {
  Result<PointCloud> triangulate(const RectifiedPair& pair, const MatchSet& matches,
                                 StageContext& context) const;
};

// Places on the planes at unit depth in front of two cameras.
struct PlacePair {
  Vec2d left;
  Vec2d right;
};

// E with (left, 1)^T E (right, 1) = 0 where two lines of sight meet; row-major.
struct EpipolarRelation {
  double m[9];
};

// Moves both places so that their lines of sight meet.
PlacePair correct_optimally(const EpipolarRelation& e, const PlacePair& seen);

// OptimalTriangulator ("optimal"): the point whose images are nearest to what was seen, by Lindstrom's two
// steps ("Triangulation Made Easy", CVPR 2010, niter2): both places are moved by the least squared distance
// that makes their lines of sight meet, in the cameras' own image planes (focal lengths taken as equal,
// distortion gone), where noise is alike in all directions, not in the rectified planes, which a toed-in rig
// stretches.
//
// The partner's row is the keypoint's row plus the set's epipolar_shift where that was measured. Rows that
// agree exactly leave nothing to correct: the result is then that of inverse-disparity. sigma_mm as there.
struct OptimalTriangulator {
  Result<PointCloud> triangulate(const RectifiedPair& pair, const MatchSet& matches,
                                 StageContext& context) const;
};

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a surface stands out of its surroundings as a nose does, whichever way it is turned
// (cf. Xu, Wang, Tan, Quan, AMFG 2006: local convexity finds noses before pose is known).
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "pipeline/mesh/landmarks/symmetry_plane.h"

namespace relievo::pipeline {

struct NoseCandidate {
  Eigen::Vector3d at_mm = Eigen::Vector3d::Zero();
  double protrusion_mm = 0;  // how far the ring 18 to 28 mm around lies behind, on average; noses 8 to 16
};

struct NoseCandidates {
  std::array<NoseCandidate, 4> best;  // falling protrusion, at least 25 mm apart
  std::size_t count = 0;
};

// Any frame. Places at the rim of the surface, whose ring is not closed, do not stand as candidates.
NoseCandidates find_nose_candidates(std::span<const SurfacePoint> points);

}  // namespace relievo::pipeline

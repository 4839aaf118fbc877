// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What of a rough surface lies within reach of the face: shoulders, collar and neck need not be refined, since
// they are cropped later (reconstruct/face_crop.h); on some pictures they are a third of all.
// Memory: scratch only. Thread: any; deterministic.
#pragma once

#include <span>

#include "pipeline/match/refine/surface_refiner.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// Where, in shares of the face's width around its middle, every nose is: 38 mm on a grown-up.
inline constexpr double kNoseReach = 0.25;

// The tip of the nose: the mean of the nearest hundredth of points of the middle of the face, for a single stray
// point is none. Any frame whose z leads away from the cameras; reorders the points, of which there must be 10 or more.
Vec3d nearest_tip(std::span<Vec3d> middle);

// Takes nodes out of the domain that lie further than pair.face_reach_mm from the surface nearest to the
// cameras in the middle of the face. Does nothing where no face was looked for, or where hardly anything lies there.
void keep_within_reach(const RectifiedPair& pair, StageContext& context, SurfaceField& field);

}  // namespace relievo::pipeline

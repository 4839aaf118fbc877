// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What of a rough surface lies within reach of the face: shoulders, collar and neck need not be refined, since
// they are cropped later (reconstruct/face_crop.h); on some pictures they are a third of all.
// Memory: scratch only. Thread: any; deterministic.
#pragma once

#include "pipeline/match/refine/surface_refiner.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// Takes nodes out of the domain that lie further than pair.face_reach_mm from the surface nearest to the
// cameras in the middle of the face. Does nothing where no face was looked for, or where hardly anything lies there.
void keep_within_reach(const RectifiedPair& pair, StageContext& context, SurfaceField& field);

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What can be said about a finished surface and its texture without knowing the truth. Memory: scratch only;
// throws std::bad_alloc. Thread: any.
#pragma once

#include "pipeline/base/stage.h"
#include "pipeline/mesh/landmarks/head_frame.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/face_model.h"
#include "pipeline/model/texture_atlas.h"

namespace relievo::pipeline {

// Everything but epipolar_residual_px (the matches know it), relief and texture_sharpness.
ModelQuality measure_quality(const FaceMesh& mesh, const HeadFrame& frame, StageContext& context);

// How sharp a texture is, from itself alone (Crete, Dolmiere, Ladret, Nicolas, The blur effect: perception
// and estimation with a new no-reference perceptual blur metric, SPIE 6492, 2007): the less neighbouring
// texels lose when it is blurred once more, the more blurred it was. 1 minus their figure: 0 blurred to 1
// sharp. Only photographed texels count; 0 where there are none.
double texture_sharpness(const TextureAtlas& atlas, StageContext& context);

}  // namespace relievo::pipeline

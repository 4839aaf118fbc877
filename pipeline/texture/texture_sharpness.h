// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How sharp a texture is, from itself alone: F. Crete, T. Dolmiere, P. Ladret, M. Nicolas: "The blur
// effect: perception and estimation with a new no-reference perceptual blur metric", SPIE 6492, 2007.
// The texture is blurred once more; the less its neighbouring texels lose by that, the more blurred
// it was. 1 minus their figure: 0 blurred to 1 sharp. Only photographed texels count.
#pragma once

#include "pipeline/base/stage.h"
#include "pipeline/model/texture_atlas.h"

namespace relievo::pipeline {

// 0 where nothing was photographed. Memory: scratch only; throws std::bad_alloc. Thread: any.
double texture_sharpness(const TextureAtlas& atlas, StageContext& context);

}  // namespace relievo::pipeline

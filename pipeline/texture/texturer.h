// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Texturer: lays the pictures of both views over the surface.
// Errors: OutOfMemory, Cancelled, InvalidInput (a mesh without triangles).
#pragma once

#include <functional>

#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/model/texture_atlas.h"

namespace relievo::pipeline {

using Texturer = std::function<Result<TextureAtlas>(const FaceMesh& mesh, const RectifiedPair& pair,
                                                    StageContext& context)>;

}  // namespace relievo::pipeline

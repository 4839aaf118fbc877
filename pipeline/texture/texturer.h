// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Texturer: lays the pictures of both views over the surface.
// Errors: OutOfMemory, Cancelled, InvalidInput (a mesh without triangles).
#pragma once

#include <string_view>

#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/model/texture_atlas.h"

namespace relievo::pipeline {

class Texturer {
 public:
  virtual ~Texturer() = default;
  virtual std::string_view name() const = 0;
  virtual Result<TextureAtlas> texture(const FaceMesh& mesh, const RectifiedPair& pair,
                                       StageContext& context) const = 0;
};

}  // namespace relievo::pipeline

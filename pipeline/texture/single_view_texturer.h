// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SingleViewTexturer (`single-view`): the left photograph alone, as the dissertation does;
// what it does not see is filled.
// Memory: atlas, uv and vertex colours in `output`, the rest in `scratch`; nothing else.
// Errors: InvalidInput (a mesh without triangles, a pair without pixels), OutOfMemory, Cancelled.
// Thread: any; keeps no state.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/texture/texturer.h"

namespace relievo::pipeline {

struct SingleViewTexturer {
  int max_atlas_px = 2048;  // widest and highest atlas
  int margin_px = 8;        // texels left free around the face

  Result<void> check() const;

  void describe(auto&& field) {
    field("max_atlas_px", max_atlas_px, OptionRange{64, 8192}, "widest and highest atlas, pixels");
    field("margin_px", margin_px, OptionRange{0, 256}, "texels left free around the face");
  }
  Result<TextureAtlas> texture(const FaceMesh& mesh, const RectifiedPair& pair, StageContext& context) const;
};

}  // namespace relievo::pipeline

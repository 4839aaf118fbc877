// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/single_view_texturer.h"

#include "pipeline/texture/photograph_layer.h"

namespace relievo::pipeline {

Result<void> SingleViewTexturer::check() const {
  if (4 * margin_px > max_atlas_px)
    return Error{Errc::InvalidInput, "margin_px must be at most a quarter of max_atlas_px"}.at("single-view");
  return {};
}

Result<TextureAtlas> SingleViewTexturer::texture(const FaceMesh& mesh, const RectifiedPair& pair,
                                                 StageContext& context) const {
  LayerOptions layer;
  layer.chart = {max_atlas_px, margin_px};
  layer.shot.left_only = true;
  return lay_photographs(mesh, pair, layer, context);
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/texturers.h"

#include "pipeline/texture/photograph_layer.h"

namespace relievo::pipeline {

Result<void> TwoViewTexturer::check() const {
  if (4 * margin_px > max_atlas_px)
    return Error{Errc::InvalidInput, "margin_px must be at most a quarter of max_atlas_px"}.at("two-view");
  return {};
}

Result<TextureAtlas> TwoViewTexturer::texture(const FaceMesh& mesh, const RectifiedPair& pair,
                                              StageContext& context) const {
  LayerOptions layer;
  layer.chart = {max_atlas_px, margin_px, finer};
  layer.shot = {static_cast<float>(angle_power), static_cast<float>(occlusion_px),
                static_cast<float>(feather_px), false};
  layer.highlight_level = static_cast<float>(highlight_level);
  return lay_photographs(mesh, pair, layer, context);
}

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

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/two_view_texturer.h"

#include "pipeline/texture/photograph_layer.h"

namespace relievo::pipeline {

Result<void> TwoViewTexturerOptions::check() const {
  if (max_atlas_px < 64 || max_atlas_px > 8192)
    return Error{Errc::InvalidInput, "max_atlas_px must lie in 64 .. 8192"}.at("texturer.two-view");
  if (margin_px < 0 || margin_px > 256 || 4 * margin_px > max_atlas_px)
    return Error{Errc::InvalidInput, "margin_px must lie in 0 .. 256 and within a quarter of max_atlas_px"}
        .at("texturer.two-view");
  if (!(finer >= 0.25 && finer <= 4))
    return Error{Errc::InvalidInput, "finer must lie in 0.25 .. 4"}.at("texturer.two-view");
  if (!(angle_power >= 0 && angle_power <= 64) || !(occlusion_px >= 0 && occlusion_px <= 64))
    return Error{Errc::InvalidInput, "angle_power 0 .. 64, occlusion_px 0 .. 64"}.at("texturer.two-view");
  if (!(feather_px >= 0 && feather_px <= 32) || !(highlight_level >= 0 && highlight_level <= 255))
    return Error{Errc::InvalidInput, "feather_px 0 .. 32, highlight_level 0 .. 255"}.at("texturer.two-view");
  return {};
}

Result<TextureAtlas> TwoViewTexturer::texture(const FaceMesh& mesh, const RectifiedPair& pair,
                                              StageContext& context) const {
  RELIEVO_TRY(options_.check());
  LayerOptions layer;
  layer.chart = {options_.max_atlas_px, options_.margin_px, options_.finer};
  layer.shot = {static_cast<float>(options_.angle_power), static_cast<float>(options_.occlusion_px),
                static_cast<float>(options_.feather_px), false};
  layer.highlight_level = static_cast<float>(options_.highlight_level);
  return lay_photographs(mesh, pair, layer, context);
}

}  // namespace relievo::pipeline

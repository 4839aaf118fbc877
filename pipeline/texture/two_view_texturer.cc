// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/two_view_texturer.h"

#include "pipeline/texture/photograph_layer.h"

namespace relievo::pipeline {

Result<void> TwoViewTexturerOptions::check() const {
  if (4 * margin_px > max_atlas_px)
    return Error{Errc::InvalidInput, "margin_px must be at most a quarter of max_atlas_px"}.at("two-view");
  return {};
}

Result<TextureAtlas> TwoViewTexturer::texture(const FaceMesh& mesh, const RectifiedPair& pair,
                                              StageContext& context) const {
  RELIEVO_TRY(check_options(options_, "two-view"));
  LayerOptions layer;
  layer.chart = {options_.max_atlas_px, options_.margin_px, options_.finer};
  layer.shot = {static_cast<float>(options_.angle_power), static_cast<float>(options_.occlusion_px),
                static_cast<float>(options_.feather_px), false};
  layer.highlight_level = static_cast<float>(options_.highlight_level);
  return lay_photographs(mesh, pair, layer, context);
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/single_view_texturer.h"

#include "pipeline/texture/chart.h"
#include "pipeline/texture/photo_sampler.h"

namespace relievo::pipeline {

Result<void> SingleViewTexturerOptions::check() const {
  if (max_atlas_px < 64 || max_atlas_px > 8192)
    return Error{Errc::InvalidInput, "max_atlas_px must lie in 64 .. 8192"}.at("texturer.single-view");
  if (margin_px < 0 || margin_px > 256 || 4 * margin_px > max_atlas_px)
    return Error{Errc::InvalidInput, "margin_px must lie in 0 .. 256 and within a quarter of max_atlas_px"}.at("texturer.single-view");
  return {};
}

Result<TextureAtlas> SingleViewTexturer::texture(const FaceMesh& mesh, const RectifiedPair& pair,
                                                 StageContext& context) const {
  RELIEVO_TRY(options_.check());
  RELIEVO_TRY(check_texture_input(mesh, pair));
  const Error stopped{Errc::Cancelled, "texturing was stopped"};
  if (context.stop()) return stopped;
  const Chart chart = lay_out(mesh, pair, options_.max_atlas_px, options_.margin_px, &context.scratch);
  const std::pmr::vector<float> front = front_disparity(mesh, chart, &context.scratch);
  if (context.stop()) return stopped;

  TextureAtlas atlas(&context.output);
  atlas.width_px = chart.width_px;
  atlas.height_px = chart.height_px;
  atlas.rgb.assign(3 * chart.size(), 0);
  const PhotoSampler left(pair.left, pair.width_px, pair.height_px);
  for (std::size_t k = 0; k < chart.size(); ++k) {
    if (front[k] <= kNoSurface) continue;
    const std::size_t w = static_cast<std::size_t>(chart.width_px);
    float rgb[3];
    left.read(chart.left_x(static_cast<float>(k % w)), chart.left_y(static_cast<float>(k / w)), rgb);
    for (std::size_t i = 0; i < 3; ++i) atlas.rgb[3 * k + i] = to_byte(rgb[i]);
  }
  if (context.stop()) return stopped;
  continue_outwards(chart, front, atlas.rgb);
  write_uv(mesh, chart, atlas);
  colour_vertices(chart, atlas);
  return atlas;
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/two_view_texturer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/texture/chart.h"
#include "pipeline/texture/photo_sampler.h"
#include "pipeline/texture/view_weights.h"

namespace relievo::pipeline {
namespace {

using Gains = std::array<float, 3>;

constexpr int kBands = 32;  // of rows, for the pool and for looking at the stop flag

// Everything a band of rows needs; one reference fits into the pool's callable without an allocation.
struct Shading {
  const Chart& chart;
  std::span<const float> front;
  std::span<const float> share;  // of the right view, one a texel
  PhotoSampler left;
  PhotoSampler right;
  Gains gain;                    // of the right view
  float highlight_level;
  std::span<std::uint8_t> rgb;
  StageContext& context;

  void read(std::size_t k, int x, int y, float (&l)[3], float (&r)[3]) const {
    const float px = chart.left_x(static_cast<float>(x));
    const float py = chart.left_y(static_cast<float>(y));
    left.read(px, py, l);
    right.read(px - front[k], py, r);
  }

  void shade_row(int y) const {
    std::size_t k = static_cast<std::size_t>(y) * static_cast<std::size_t>(chart.width_px);
    for (int x = 0; x < chart.width_px; ++x, ++k) {
      if (front[k] <= kNoSurface) continue;
      float l[3];
      if (share[k] <= 0) {
        left.read(chart.left_x(static_cast<float>(x)), chart.left_y(static_cast<float>(y)), l);
        for (std::size_t i = 0; i < 3; ++i) rgb[3 * k + i] = to_byte(l[i]);
        continue;
      }
      float r[3];
      read(k, x, y, l, r);
      for (std::size_t i = 0; i < 3; ++i) r[i] *= gain[i];
      const float w = settle(share[k], l[1], r[1]);
      for (std::size_t i = 0; i < 3; ++i) rgb[3 * k + i] = to_byte(l[i] + w * (r[i] - l[i]));
    }
  }

  // Skin shines towards one camera only: where the views disagree strongly the darker one is skin.
  float settle(float w, float left_green, float right_green) const {
    if (highlight_level <= 0) return w;
    const float excess = (left_green - right_green) / highlight_level;
    const float trust = std::clamp(std::abs(excess) - 1, 0.0F, 1.0F);
    if (w >= 1) return w;  // the other does not see it at all
    return w + trust * ((excess > 0 ? 1.0F : 0.0F) - w);
  }
};

// Ratio of the sums over texels both views see well: less noisy than a mean of ratios, and pixels
// that are black or blown out say nothing about exposure.
Gains match_exposure(const Shading& s) {
  constexpr int kEvery = 4;
  double left_sum[3] = {0, 0, 0};
  double right_sum[3] = {0, 0, 0};
  for (int y = 0; y < s.chart.height_px; y += kEvery)
    for (int x = 0; x < s.chart.width_px; x += kEvery) {
      const std::size_t k = static_cast<std::size_t>(y) * static_cast<std::size_t>(s.chart.width_px) + static_cast<std::size_t>(x);
      if (s.front[k] <= kNoSurface || s.share[k] < 0.2F || s.share[k] > 0.8F) continue;
      float l[3];
      float r[3];
      s.read(k, x, y, l, r);
      if (std::max({l[0], l[1], l[2], r[0], r[1], r[2]}) > 245 || std::min(l[1], r[1]) < 10) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        left_sum[i] += static_cast<double>(l[i]);
        right_sum[i] += static_cast<double>(r[i]);
      }
    }
  Gains gain{1, 1, 1};
  for (std::size_t i = 0; i < 3; ++i)
    if (right_sum[i] > 0) gain[i] = static_cast<float>(std::clamp(left_sum[i] / right_sum[i], 0.25, 4.0));
  return gain;
}

}  // namespace

Result<void> TwoViewTexturerOptions::check() const {
  if (max_atlas_px < 64 || max_atlas_px > 8192)
    return Error{Errc::InvalidInput, "max_atlas_px must lie in 64 .. 8192"}.at("texturer.two-view");
  if (margin_px < 0 || margin_px > 256 || 4 * margin_px > max_atlas_px)
    return Error{Errc::InvalidInput, "margin_px must lie in 0 .. 256 and within a quarter of max_atlas_px"}.at("texturer.two-view");
  if (!(angle_power >= 0 && angle_power <= 64) || !(occlusion_px >= 0 && occlusion_px <= 64))
    return Error{Errc::InvalidInput, "angle_power 0 .. 64, occlusion_px 0 .. 64"}.at("texturer.two-view");
  if (feather_passes < 0 || feather_passes > 32 || !(highlight_level >= 0 && highlight_level <= 255))
    return Error{Errc::InvalidInput, "feather_passes 0 .. 32, highlight_level 0 .. 255"}.at("texturer.two-view");
  return {};
}

Result<TextureAtlas> TwoViewTexturer::texture(const FaceMesh& mesh, const RectifiedPair& pair,
                                              StageContext& context) const {
  RELIEVO_TRY(options_.check());
  RELIEVO_TRY(check_texture_input(mesh, pair));
  const Error stopped{Errc::Cancelled, "texturing was stopped"};
  if (context.stop()) return stopped;
  const Chart chart = lay_out(mesh, pair, options_.max_atlas_px, options_.margin_px, &context.scratch);
  const std::pmr::vector<float> front = front_disparity(mesh, chart, &context.scratch);
  if (context.stop()) return stopped;
  const std::pmr::vector<float> vertex_share = right_share(
      mesh, pair, chart, front,
      {static_cast<float>(options_.angle_power), static_cast<float>(options_.occlusion_px), options_.feather_passes},
      &context.scratch);
  std::pmr::vector<float> share(chart.size(), 0.0F, &context.scratch);
  spread(mesh, chart, front, vertex_share, share);
  if (context.stop()) return stopped;

  TextureAtlas atlas(&context.output);
  atlas.width_px = chart.width_px;
  atlas.height_px = chart.height_px;
  atlas.rgb.assign(3 * chart.size(), 0);
  Shading shading{chart, front, share, {pair.left, pair.width_px, pair.height_px}, {pair.right, pair.width_px, pair.height_px},
                  {1, 1, 1}, static_cast<float>(options_.highlight_level), atlas.rgb, context};
  shading.gain = match_exposure(shading);
  context.pool.for_each_band(chart.height_px, kBands, [&shading](int begin, int end, int) {
    for (int y = begin; y < end && !shading.context.stop(); ++y) shading.shade_row(y);
  });
  if (context.stop()) return stopped;
  continue_outwards(chart, front, atlas.rgb);
  write_uv(mesh, chart, atlas);
  colour_vertices(chart, atlas);
  context.progress.done.store(1, std::memory_order_relaxed);
  return atlas;
}

}  // namespace relievo::pipeline

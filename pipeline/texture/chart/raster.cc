// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/chart/raster.h"

namespace relievo::pipeline {

RowBands::RowBands(const FaceMesh& mesh, const Chart& chart, int bands, std::pmr::memory_resource* memory)
    : bands_(std::clamp(bands, 1, std::max(chart.height_px, 1))),
      height_(chart.height_px),
      triangles_(memory) {
  triangles_.sort(std::size_t(bands_), [&](auto&& add) {
    for (std::uint32_t k = 0; k < mesh.triangles.size(); ++k) {
      const auto& t = mesh.triangles[k];
      if (!all_three(chart.placed, t)) continue;
      const float a = chart.texel[t[0]].y;
      const float b = chart.texel[t[1]].y;
      const float c = chart.texel[t[2]].y;
      const int last = band_of(std::max({a, b, c}) + 1);
      for (int band = band_of(std::min({a, b, c}) - 1); band <= last; ++band) add(std::size_t(band), k);
    }
  });
}

// The band whose rows hold this one; as rows() cuts them.
int RowBands::band_of(float y) const {
  const int row = std::clamp(int(y), 0, height_ - 1);
  int band = std::min(bands_ - 1, row * bands_ / height_);
  while (band + 1 < bands_ && rows(band).end <= row) ++band;
  return band;
}

FrontMap::FrontMap(const Chart& chart, float at_side, std::pmr::memory_resource* memory)
    : side(at_side), scale(float(chart.texels_per_px)), nearest(memory), owner(memory) {
  height_px = chart.height_px;
  float least = 1e30F;
  float most = -1e30F;
  for (std::size_t v = 0; v < chart.texel.size(); ++v) {
    if (chart.placed[v] == 0) continue;
    least = std::min(least, chart.texel[v].x + side * chart.disparity_px[v] * scale);
    most = std::max(most, chart.texel[v].x + side * chart.disparity_px[v] * scale);
  }
  const bool middle = side == 0.0F;
  shift = middle || most < least ? 0.0F : std::floor(least) - 1;
  // A view is a picture's part: what would be wider is no surface of one.
  width_px = middle ? chart.width_px : int(std::clamp(most - least, 0.0F, 16384.0F)) + 4;
  const std::size_t size = pixels();
  nearest.assign(size, kNothingThere);
  if (middle) owner.assign(size, kNoTriangle);
}

bool FrontMap::sees(const Vec2f& texel, float disparity, float tolerance_px) const {
  const int x = int(std::lround(column(texel.x, disparity)));
  const int y = int(std::lround(texel.y));
  return !inside(x, y) || nearest[index(x, y)] <= disparity + tolerance_px;
}

namespace {

void draw(const FaceMesh& mesh, const Chart& chart, std::span<const std::uint32_t> triangles, RowRange rows,
          FrontMap& map) {
  for (const std::uint32_t k : triangles) {
    const auto& t = mesh.triangles[k];
    const float da = chart.disparity_px[t[0]];
    const float db = chart.disparity_px[t[1]];
    const float dc = chart.disparity_px[t[2]];
    const auto at = [&](std::uint32_t v, float d) {
      return Vec2f{map.column(chart.texel[v].x, d), chart.texel[v].y};
    };
    for_each_texel(at(t[0], da), at(t[1], db), at(t[2], dc), map.width_px, rows,
                   [&](int x, int y, float wa, float wb, float wc) {
                     const std::size_t i = map.index(x, y);
                     const float d = wa * da + wb * db + wc * dc;
                     if (d <= map.nearest[i]) return;
                     map.nearest[i] = d;
                     if (!map.owner.empty()) map.owner[i] = k;
                   });
  }
}

}  // namespace

void fill_front_maps(const FaceMesh& mesh, const Chart& chart, const RowBands& bands,
                     std::span<FrontMap> maps, StageContext& context) {
  context.pool.for_each(bands.count(), bands.count(), [&](int band) {
    if (context.stop()) return;
    for (FrontMap& map : maps) draw(mesh, chart, bands.triangles(band), bands.rows(band), map);
  });
}

}  // namespace relievo::pipeline

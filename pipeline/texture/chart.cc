// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/chart.h"

#include <algorithm>
#include <cmath>

namespace relievo::pipeline {
namespace {

struct Place { Vec2d left_px; double disparity_px; };

Place place_of(const Vec3f& at_mm, const RectifiedPair& pair) {
  const Vec3d p = apply(pair.rectified_from_left, Vec3d{static_cast<double>(at_mm.x), static_cast<double>(at_mm.y),
                                                        static_cast<double>(at_mm.z)});
  const double z = std::max(p.z, 1.0);  // nothing is measured within a millimetre of the lens
  return {{pair.left_centre_px.x + pair.focal_px * p.x / z, pair.left_centre_px.y + pair.focal_px * p.y / z},
          pair.disparity_px(z)};
}

// Calls paint(index, a, b, c) with the weights of the corners for every texel of the triangle.
template <typename Paint>
void for_each_texel(const Chart& chart, const std::array<std::uint32_t, 3>& t, Paint&& paint) {
  const Vec2f& a = chart.texel[t[0]];
  const Vec2f& b = chart.texel[t[1]];
  const Vec2f& c = chart.texel[t[2]];
  const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (!(std::abs(area) > 1e-6F)) return;
  const float to_unit = 1 / area;
  // A hair beyond the edges, so that rounding opens no crack between neighbours and takes no texel
  // from a vertex that lies on its centre.
  constexpr float kHair = 0.01F;
  constexpr float kEdge = -1e-3F;
  const int top = std::max(0, static_cast<int>(std::ceil(std::min({a.y, b.y, c.y}) - kHair)));
  const int bottom = std::min(chart.height_px - 1, static_cast<int>(std::floor(std::max({a.y, b.y, c.y}) + kHair)));
  const int left = std::max(0, static_cast<int>(std::ceil(std::min({a.x, b.x, c.x}) - kHair)));
  const int right = std::min(chart.width_px - 1, static_cast<int>(std::floor(std::max({a.x, b.x, c.x}) + kHair)));
  for (int y = top; y <= bottom; ++y) {
    const float dy = static_cast<float>(y) - a.y;
    std::size_t k = static_cast<std::size_t>(y) * static_cast<std::size_t>(chart.width_px) + static_cast<std::size_t>(left);
    for (int x = left; x <= right; ++x, ++k) {
      const float dx = static_cast<float>(x) - a.x;
      const float wb = (dx * (c.y - a.y) - dy * (c.x - a.x)) * to_unit;
      const float wc = ((b.x - a.x) * dy - (b.y - a.y) * dx) * to_unit;
      if (wb < kEdge || wc < kEdge || wb + wc > 1 - kEdge) continue;
      paint(k, 1 - wb - wc, wb, wc);
    }
  }
}

void copy_texel(std::span<std::uint8_t> rgb, std::size_t from, std::size_t to) {
  for (std::size_t i = 0; i < 3; ++i) rgb[3 * to + i] = rgb[3 * from + i];
}

}  // namespace

Result<void> check_texture_input(const FaceMesh& mesh, const RectifiedPair& pair) {
  if (mesh.triangles.empty() || mesh.vertices_mm.empty() || mesh.normals.size() != mesh.vertices_mm.size())
    return Error{Errc::InvalidInput, "there is no surface to lay a photograph on"};
  const std::size_t bytes = 3 * static_cast<std::size_t>(std::max(pair.width_px, 0)) * static_cast<std::size_t>(std::max(pair.height_px, 0));
  if (bytes == 0 || pair.left.rgb.size() != bytes || pair.right.rgb.size() != bytes || !(pair.focal_px > 0))
    return Error{Errc::InvalidInput, "the rectified pair has no colours to lay on the surface"};
  return {};
}

Chart lay_out(const FaceMesh& mesh, const RectifiedPair& pair, int max_px, int margin_px,
              std::pmr::memory_resource* memory) {
  Chart chart(memory);
  chart.texel.reserve(mesh.vertices_mm.size());
  chart.disparity_px.reserve(mesh.vertices_mm.size());
  Vec2d from{1e9, 1e9};
  Vec2d to{-1e9, -1e9};
  for (const Vec3f& v : mesh.vertices_mm) {
    Place place = place_of(v, pair);
    // What lies outside the picture has no colour; it must not blow the chart up either.
    place.left_px.x = std::clamp(place.left_px.x, 0.0, pair.width_px - 1.0);
    place.left_px.y = std::clamp(place.left_px.y, 0.0, pair.height_px - 1.0);
    chart.texel.push_back({static_cast<float>(place.left_px.x), static_cast<float>(place.left_px.y)});
    chart.disparity_px.push_back(static_cast<float>(place.disparity_px));
    from = {std::min(from.x, place.left_px.x), std::min(from.y, place.left_px.y)};
    to = {std::max(to.x, place.left_px.x), std::max(to.y, place.left_px.y)};
  }
  const double room = max_px - 2 * margin_px - 2;
  chart.texels_per_px = std::min(1.0, room / std::max({to.x - from.x, to.y - from.y, 1.0}));
  // Whole pixels: at one texel a pixel the left photograph is then copied, not interpolated.
  chart.origin_px = {std::floor(from.x) - margin_px / chart.texels_per_px,
                     std::floor(from.y) - margin_px / chart.texels_per_px};
  chart.width_px = static_cast<int>(std::ceil((to.x - chart.origin_px.x) * chart.texels_per_px)) + margin_px + 1;
  chart.height_px = static_cast<int>(std::ceil((to.y - chart.origin_px.y) * chart.texels_per_px)) + margin_px + 1;
  for (Vec2f& t : chart.texel)
    t = {static_cast<float>((static_cast<double>(t.x) - chart.origin_px.x) * chart.texels_per_px),
         static_cast<float>((static_cast<double>(t.y) - chart.origin_px.y) * chart.texels_per_px)};
  return chart;
}

std::pmr::vector<float> front_disparity(const FaceMesh& mesh, const Chart& chart, std::pmr::memory_resource* memory) {
  std::pmr::vector<float> front(chart.size(), kNoSurface, memory);
  for (const auto& t : mesh.triangles) {
    const float a = chart.disparity_px[t[0]];
    const float b = chart.disparity_px[t[1]];
    const float c = chart.disparity_px[t[2]];
    for_each_texel(chart, t, [&](std::size_t k, float wa, float wb, float wc) {
      front[k] = std::max(front[k], wa * a + wb * b + wc * c);
    });
  }
  return front;
}

void spread(const FaceMesh& mesh, const Chart& chart, std::span<const float> front,
            std::span<const float> value, std::span<float> target) {
  constexpr float kSame = 0.25F;  // pixels of disparity: this triangle's own, rounding included
  for (const auto& t : mesh.triangles) {
    const float a = chart.disparity_px[t[0]];
    const float b = chart.disparity_px[t[1]];
    const float c = chart.disparity_px[t[2]];
    for_each_texel(chart, t, [&](std::size_t k, float wa, float wb, float wc) {
      if (wa * a + wb * b + wc * c >= front[k] - kSame)
        target[k] = wa * value[t[0]] + wb * value[t[1]] + wc * value[t[2]];
    });
  }
}

void write_uv(const FaceMesh& mesh, const Chart& chart, TextureAtlas& atlas) {
  atlas.uv.reserve(3 * mesh.triangles.size());
  const float to_u = 1 / static_cast<float>(chart.width_px);
  const float to_v = 1 / static_cast<float>(chart.height_px);
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t)
      atlas.uv.push_back({(chart.texel[v].x + 0.5F) * to_u, (chart.texel[v].y + 0.5F) * to_v});
}

void continue_outwards(const Chart& chart, std::span<const float> front, std::span<std::uint8_t> rgb) {
  const std::size_t w = static_cast<std::size_t>(chart.width_px);
  const std::size_t h = static_cast<std::size_t>(chart.height_px);
  const auto owned = [&](std::size_t k) { return front[k] > kNoSurface; };
  // The outermost texels mix in what lies behind the face: the colour comes from a little further in.
  const auto inner_left = [&](std::size_t k, std::size_t x) {
    std::size_t steps = 0;
    while (steps < 3 && x + steps + 1 < w && owned(k + steps + 1)) ++steps;
    return k + steps;
  };
  const auto inner_right = [&](std::size_t k, std::size_t x) {
    std::size_t steps = 0;
    while (steps < 3 && x > steps && owned(k - steps - 1)) ++steps;
    return k - steps;
  };
  // Along each row from its outermost and inner edges, so holes are bridged too ...
  for (std::size_t y = 0; y < h; ++y) {
    std::size_t last = w;
    for (std::size_t x = 0; x < w; ++x) {
      const std::size_t k = y * w + x;
      if (!owned(k)) continue;
      const std::size_t gap_from = last == w ? 0 : last + 1;
      if (gap_from < x) {
        const std::size_t before = last == w ? 0 : inner_right(y * w + last, last);
        const std::size_t after = inner_left(k, x);
        for (std::size_t g = gap_from; g < x; ++g)
          copy_texel(rgb, last != w && g - last < x - g ? before : after, y * w + g);
      }
      last = x;
    }
    for (std::size_t g = last + 1; last != w && g < w; ++g) copy_texel(rgb, inner_right(y * w + last, last), y * w + g);
  }
  // ... then rows without any surface take their nearest neighbour's.
  const auto has_surface = [&](std::size_t y) {
    return std::any_of(&front[y * w], &front[y * w] + w, [](float d) { return d > kNoSurface; });
  };
  const auto copy_row = [&](std::size_t from, std::size_t to) {
    std::copy_n(&rgb[3 * from * w], 3 * w, &rgb[3 * to * w]);
  };
  std::size_t last = h;
  for (std::size_t y = 0; y < h; ++y) {
    if (has_surface(y)) {
      for (std::size_t up = y; last == h && up > 0; --up) copy_row(y, up - 1);
      last = y;
    } else if (last != h) {
      copy_row(last, y);
    }
  }
}

void colour_vertices(const Chart& chart, TextureAtlas& atlas) {
  atlas.vertex_rgb.reserve(3 * chart.texel.size());
  const std::size_t w = static_cast<std::size_t>(chart.width_px);
  for (const Vec2f& t : chart.texel) {
    const auto x = static_cast<std::size_t>(std::clamp(std::lround(t.x), 0L, static_cast<long>(chart.width_px) - 1));
    const auto y = static_cast<std::size_t>(std::clamp(std::lround(t.y), 0L, static_cast<long>(chart.height_px) - 1));
    for (std::size_t i = 0; i < 3; ++i) atlas.vertex_rgb.push_back(atlas.rgb[3 * (y * w + x) + i]);
  }
}

}  // namespace relievo::pipeline

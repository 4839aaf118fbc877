// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/texturers.h"

#include <algorithm>
#include <cmath>

#include "pipeline/base/stage.h"
#include "pipeline/model/photo_sampler.h"
#include "pipeline/model/texture_atlas.h"
#include "pipeline/texture/blend/shot_planes.h"
#include "pipeline/texture/blend/view_blend.h"
#include "pipeline/texture/chart/chart.h"
#include "pipeline/texture/colour_fill.h"

namespace relievo::pipeline {
namespace {

constexpr int kBands = 48;       // of rows, for the pool and for looking at the stop flag
constexpr float kOwnPx = 0.75F;  // disparity by which rounding lets a triangle seem to lie behind itself

std::uint8_t origin_of(float right_share) {
  return std::uint8_t(kLeftPhotographTexel + std::lround(253 * std::clamp(right_share, 0.0F, 1.0F)));
}

// What no texturer can work with.
Result<void> check_input(const FaceMesh& mesh, const RectifiedPair& pair) {
  const std::size_t n = mesh.vertices_mm.size();
  if (mesh.triangles.empty() || n == 0 || mesh.normals.size() != n ||
      (!mesh.measured.empty() && mesh.measured.size() != n))
    return invalid("there is no surface to lay a photograph on");
  const std::size_t bytes =
      3 * std::size_t(std::max(pair.width_px, 0)) * std::size_t(std::max(pair.height_px, 0));
  if (bytes == 0 || pair.left.rgb.size() != bytes || pair.right.rgb.size() != bytes || !(pair.focal_px > 0))
    return invalid("the rectified pair has no colours to lay on the surface");
  return {};
}

// The whole way from a surface and its photographs to an atlas, for both texturers. Surface that a camera saw
// shows its photograph, measured or not; what none saw is filled smoothly and flagged in `origin`.
class Layer {
 public:
  // Without the right photograph where `left_only`.
  Layer(const FaceMesh& mesh, const RectifiedPair& pair, const TwoViewTexturer& options, bool left_only,
        StageContext& context)
      : mesh_(mesh),
        pair_(pair),
        options_(options),
        shot_{float(options.angle_power), float(options.occlusion_px), float(options.feather_px), left_only},
        context_(context) {}

  Result<TextureAtlas> run() {
    fill_front_maps(mesh_, chart_, bands_, maps_, context_);
    if (context_.stop()) return stopped();
    const VertexViews views = look_at_vertices(mesh_, pair_, chart_, maps_[1], maps_[2], shot_, context_);
    if (context_.stop()) return stopped();
    choose(views);
    sides_ = lay_out_sides(mesh_, chart_, kept_, photographed_, photograph_px_per_mm(), options_.max_atlas_px,
                           &context_.scratch);
    if (context_.stop()) return stopped();
    make_atlas();
    if (context_.stop()) return stopped();
    const ShotPlanes planes = shoot(mesh_, pair_, chart_, bands_, maps_, views, kept_, shot_, context_);
    if (context_.stop()) return stopped();
    const float margin_px = shot_.feather_px * float(chart_.texels_per_px);
    const bool both = !shot_.left_only;
    const ViewBlend blend(chart_, planes, bands_, both ? float(options_.highlight_level) : 0,
                          both ? margin_px : 0, context_);
    if (context_.stop()) return stopped();
    shade(planes, blend);
    if (context_.stop()) return stopped();
    photograph_sides(views, blend);
    colour_vertices();
    fill_colours(mesh_, known_, colours_, context_);
    if (context_.stop()) return stopped();
    paint_filled();
    continue_outwards(atlas_, options_.margin_px, &context_.scratch);
    write_vertex_colours(colours_, atlas_);
    return std::move(atlas_);
  }

 private:
  const Vec2f& side_corner(std::size_t side, std::size_t corner) const {
    return sides_.corner[3 * side + corner];
  }
  template <typename Visit>  // visit(vertex, texel)
  void for_each_side_corner(Visit&& visit) {
    for (std::size_t s = 0; s < sides_.triangles.size(); ++s)
      for (std::size_t i = 0; i < 3; ++i) visit(mesh_.triangles[sides_.triangles[s]][i], side_corner(s, i));
  }

  // Which triangles the main chart shows, and which vertices a camera saw.
  void choose(const VertexViews& views) {
    for (std::size_t v = 0; v < photographed_.size(); ++v) photographed_[v] = views.seen[v] != 0 ? 1 : 0;
    for (std::size_t k = 0; k < kept_.size(); ++k) {
      const auto& t = mesh_.triangles[k];
      const auto in_front = [&](std::uint32_t v) {
        return maps_[0].sees(chart_.texel[v], chart_.disparity_px[v], kOwnPx);
      };
      kept_[k] = all_three(chart_.placed, t) && signed_area(chart_, t) <= 0 && in_front(t[0]) &&
                         in_front(t[1]) && in_front(t[2])
                     ? 1
                     : 0;
    }
  }

  double photograph_px_per_mm() const {
    double sum = 0;
    double count = 0;
    for (std::size_t v = 0; v < photographed_.size(); ++v) {
      if (photographed_[v] == 0) continue;
      sum += pair_.focal_px / pair_.depth_mm(double(chart_.disparity_px[v]));
      count += 1;
    }
    return count > 0 ? sum / count : 1;
  }

  void make_atlas() {
    atlas_.width_px = chart_.width_px + sides_.width_px;
    atlas_.height_px = chart_.height_px;
    atlas_.rgb.assign(3 * atlas_.pixels(), 0);
    atlas_.origin.assign(atlas_.pixels(), kNoSurfaceTexel);
    const Vec2f to_uv{1 / float(atlas_.width_px), 1 / float(atlas_.height_px)};
    const auto uv = [&](const Vec2f& texel) {
      return Vec2f{(texel.x + 0.5F) * to_uv.x, (texel.y + 0.5F) * to_uv.y};
    };
    atlas_.uv.resize(3 * mesh_.triangles.size());
    for (std::size_t k = 0; k < kept_.size(); ++k)
      for (std::size_t i = 0; i < 3 && kept_[k] != 0; ++i)
        atlas_.uv[3 * k + i] = uv(chart_.texel[mesh_.triangles[k][i]]);
    for (std::size_t s = 0; s < sides_.triangles.size(); ++s)
      for (std::size_t i = 0; i < 3; ++i)
        atlas_.uv[3 * std::size_t{sides_.triangles[s]} + i] = uv(side_corner(s, i));
  }

  void set(std::size_t at, const float (&rgb)[3], std::uint8_t origin) {
    for (std::size_t c = 0; c < 3; ++c) atlas_.rgb[3 * at + c] = to_byte(rgb[c]);
    atlas_.origin[at] = origin;
  }

  void shade(const ShotPlanes& planes, const ViewBlend& blend) {
    context_.pool.for_each(chart_.height_px, kBands, [&](int y) {
      if (context_.stop()) return;
      for (int x = 0; x < chart_.width_px; ++x) {
        const std::size_t k = chart_.index(x, y);
        if ((planes.seen[k] & kSurface) == 0 || !all_three(photographed_, mesh_.triangles[maps_[0].owner[k]]))
          continue;
        const ViewBlend::Colour colour = blend.mix(k, x, y);
        set(atlas_.index(x, y), colour.rgb, origin_of(colour.share));
      }
    });
  }

  // What was photographed and yet does not fit into the main chart: folds, read from the photographs.
  void photograph_sides(const VertexViews& views, const ViewBlend& blend) {
    const PhotoSampler left(pair_.left.rgb, pair_.width_px, pair_.height_px);
    const PhotoSampler right(pair_.right.rgb, pair_.width_px, pair_.height_px);
    for (std::size_t s = 0; s < sides_.triangles.size(); ++s) {
      const auto& t = mesh_.triangles[sides_.triangles[s]];
      if (!all_three(photographed_, t)) continue;
      const auto mean = [&](auto&& of, float a, float b, float c) {
        return a * of(t[0]) + b * of(t[1]) + c * of(t[2]);
      };
      const std::uint8_t seen = views.seen[t[0]] & views.seen[t[1]] & views.seen[t[2]];
      for_each_texel(side_corner(s, 0), side_corner(s, 1), side_corner(s, 2), atlas_.width_px,
                     {0, atlas_.height_px}, [&](int x, int y, float a, float b, float c) {
                       const float tx = mean([&](std::uint32_t v) { return chart_.texel[v].x; }, a, b, c);
                       const float ty = mean([&](std::uint32_t v) { return chart_.texel[v].y; }, a, b, c);
                       const float d = mean([&](std::uint32_t v) { return chart_.disparity_px[v]; }, a, b, c);
                       float l[3], r[3];
                       left.read(chart_.view_x(tx, d, kLeftSide), chart_.view_y(ty), l);
                       right.read(chart_.view_x(tx, d, kRightSide), chart_.view_y(ty), r);
                       const std::uint8_t lb[3]{to_byte(l[0]), to_byte(l[1]), to_byte(l[2])};
                       const std::uint8_t rb[3]{to_byte(r[0]), to_byte(r[1]), to_byte(r[2])};
                       const auto say = [&](std::uint8_t bit) {
                         return (seen & bit) != 0 ? std::uint8_t{255} : std::uint8_t{0};
                       };
                       const float share = mean([&](std::uint32_t v) { return views.share[v]; }, a, b, c);
                       const ViewBlend::Colour colour = blend.mix(
                           {lb, rb, share, say(kSeenLeft), say(kSeenRight), seen, blend.excess_of(lb, rb)},
                           tx, ty);
                       set(atlas_.index(x, y), colour.rgb, origin_of(colour.share));
                     });
    }
  }

  // The colour of every vertex that a photograph shows, from its chart; one between completed parts stands
  // alone and takes its neighbours' colour as they do.
  void colour_vertices() {
    const auto read = [&](std::uint32_t v, const Vec2f& texel) {
      if (photographed_[v] != 0 && known_[v] == 0) known_[v] = read_clean(texel, colours_[v]) ? 1 : 0;
    };
    for_each_side_corner(read);
    for (std::size_t k = 0; k < kept_.size(); ++k)
      for (std::size_t i = 0; i < 3 && kept_[k] != 0; ++i)
        read(mesh_.triangles[k][i], chart_.texel[mesh_.triangles[k][i]]);
  }

  // As a renderer reads it, but from photographed texels alone: the others are still empty. False: none.
  bool read_clean(const Vec2f& at, VertexColour& colour) const {
    const int x = int(at.x);
    const int y = int(at.y);
    VertexColour sum{0, 0, 0};
    float weight = 0;
    for (int v = y; v <= std::min(y + 1, atlas_.height_px - 1); ++v)
      for (int u = x; u <= std::min(x + 1, atlas_.width_px - 1); ++u) {
        const std::size_t k = atlas_.index(u, v);
        const float w = (1 - std::abs(at.x - float(u))) * (1 - std::abs(at.y - float(v)));
        if (atlas_.origin[k] < kLeftPhotographTexel) continue;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += w * float(atlas_.rgb[3 * k + c]);
        weight += w;
      }
    if (weight < 1e-3F) return false;
    colour = {sum[0] / weight, sum[1] / weight, sum[2] / weight};
    return true;
  }

  void paint_filled() {
    for (std::size_t k = 0; k < kept_.size(); ++k) {
      const auto& t = mesh_.triangles[k];
      if (kept_[k] != 0 && !all_three(photographed_, t))
        fill_triangle(chart_.texel[t[0]], chart_.texel[t[1]], chart_.texel[t[2]], t, colours_,
                      chart_.width_px, atlas_);
    }
    for (std::size_t s = 0; s < sides_.triangles.size(); ++s) {
      const auto& t = mesh_.triangles[sides_.triangles[s]];
      if (!all_three(photographed_, t))
        fill_triangle(side_corner(s, 0), side_corner(s, 1), side_corner(s, 2), t, colours_, atlas_.width_px,
                      atlas_);
    }
    // A triangle between texel centres covers none: a filter reads its corners' colour around them.
    for_each_side_corner([&](std::uint32_t v, const Vec2f& at) { surround(at, colours_[v]); });
  }

  void surround(const Vec2f& corner, const VertexColour& colour) {
    const float rgb[3]{colour[0], colour[1], colour[2]};
    const int x = int(std::lround(corner.x));
    const int y = int(std::lround(corner.y));
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, atlas_.height_px - 1); ++v)
      for (int u = std::max(x - 1, chart_.width_px); u <= std::min(x + 1, atlas_.width_px - 1); ++u)
        if (atlas_.origin[atlas_.index(u, v)] == kNoSurfaceTexel) set(atlas_.index(u, v), rgb, kFilledTexel);
  }

  const FaceMesh& mesh_;
  const RectifiedPair& pair_;
  const TwoViewTexturer& options_;
  ShotOptions shot_;
  StageContext& context_;
  Chart chart_{
      lay_out(mesh_, pair_, {options_.max_atlas_px, options_.margin_px, options_.finer}, &context_.scratch)};
  RowBands bands_{mesh_, chart_, kBands, &context_.scratch};
  std::array<FrontMap, 3> maps_{FrontMap(chart_, 0, &context_.scratch),
                                FrontMap(chart_, kLeftSide, &context_.scratch),
                                FrontMap(chart_, kRightSide, &context_.scratch)};  // middle, left, right
  // A triangle: 1 in the main chart.
  std::pmr::vector<std::uint8_t> kept_{mesh_.triangles.size(), 0, &context_.scratch};
  // A vertex: 1 seen by a camera.
  std::pmr::vector<std::uint8_t> photographed_{mesh_.vertices_mm.size(), 0, &context_.scratch};
  // A vertex: 1 where a photograph gave it its colour.
  std::pmr::vector<std::uint8_t> known_{mesh_.vertices_mm.size(), 0, &context_.scratch};
  std::pmr::vector<VertexColour> colours_{mesh_.vertices_mm.size(), VertexColour{}, &context_.scratch};
  SideCharts sides_{&context_.scratch};
  TextureAtlas atlas_{&context_.output};
};

Result<TextureAtlas> lay_photographs(const FaceMesh& mesh, const RectifiedPair& pair,
                                     const TwoViewTexturer& options, bool left_only, StageContext& context) {
  RELIEVO_TRY(check_input(mesh, pair));
  if (context.stop()) return stopped();
  return Layer(mesh, pair, options, left_only, context).run();
}

Result<void> check_margin(int margin_px, int max_atlas_px, std::string_view algorithm) {
  if (4 * margin_px <= max_atlas_px) return {};
  return invalid("margin_px must be at most a quarter of max_atlas_px").at(algorithm);
}

}  // namespace

Result<void> TwoViewTexturer::check() const { return check_margin(margin_px, max_atlas_px, "two-view"); }

Result<TextureAtlas> TwoViewTexturer::texture(const FaceMesh& mesh, const RectifiedPair& pair,
                                              StageContext& context) const {
  return lay_photographs(mesh, pair, *this, false, context);
}

Result<void> SingleViewTexturer::check() const {
  return check_margin(margin_px, max_atlas_px, "single-view");
}

Result<TextureAtlas> SingleViewTexturer::texture(const FaceMesh& mesh, const RectifiedPair& pair,
                                                 StageContext& context) const {
  return lay_photographs(mesh, pair, {.max_atlas_px = max_atlas_px, .margin_px = margin_px}, true, context);
}

}  // namespace relievo::pipeline

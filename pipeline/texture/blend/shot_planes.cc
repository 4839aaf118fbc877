// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/blend/shot_planes.h"

#include <array>
#include <cmath>

#include "hal/base/statistics.h"
#include "pipeline/model/photo_sampler.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr float kLeastCosine = 0.2F;  // completed surface grazed by a view may lie behind what that shows
constexpr float kLevels = 3, kShare = 0.17F;  // by which colour may leave that beside it ...
constexpr float kHue = 0.025F;                // of a channel's part in all three
constexpr float kMemory = 0.93F;              // ... which remembers so much of where it came from

// 1 at vertices that were completed and are joined by such to the surface's border nearby.
std::pmr::vector<std::uint8_t> completed_to_border(const FaceMesh& mesh,
                                                   std::span<const Triangle> completed_parts,
                                                   StageContext& context) {
  constexpr float kReachMm = 38;
  constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  std::pmr::memory_resource* const memory = &context.scratch;
  const std::pmr::vector<std::uint8_t> at_border = border_vertices(mesh, memory);
  std::pmr::vector<std::uint32_t> border(mesh.vertices_mm.size(), kNone, memory);  // the nearest vertex of it
  const auto completed = [&](std::uint32_t v) { return !mesh.measured.empty() && mesh.measured[v] == 0; };
  for (std::uint32_t v = 0; v < border.size(); ++v)
    if (at_border[v] != 0 && completed(v)) border[v] = v;
  const auto squared_mm = [&](std::uint32_t v, std::uint32_t w) {
    return squared_distance(mesh.vertices_mm[v], mesh.vertices_mm[w]);
  };
  sweep_edges(completed_parts, context, [&](std::uint32_t from, std::uint32_t to) {
    if (border[from] == kNone || border[to] == border[from] || !completed(to)) return false;
    if (squared_mm(to, border[from]) >=
        (border[to] == kNone ? kReachMm * kReachMm : squared_mm(to, border[to])))
      return false;
    border[to] = border[from];
    return true;
  });
  std::pmr::vector<std::uint8_t> marked(border.size(), 0, memory);
  for (std::size_t v = 0; v < border.size(); ++v) marked[v] = border[v] != kNone ? 1 : 0;
  return marked;
}

// Surface that was completed up to the border lies somewhat off: a photograph may show hair or the room
// there. What it shows belongs to the face as far as its colour goes on from what was measured; beyond, the
// view is taken for not seeing it.
template <typename Colour>
void forget_what_lies_behind(std::span<const Triangle> completed_parts, std::span<const std::uint8_t> beyond,
                             std::uint8_t bit, Colour&& colour, std::span<std::uint8_t> seen,
                             StageContext& context) {
  using Rgb = std::array<float, 3>;
  std::pmr::vector<Rgb> usual(seen.size(), Rgb{-1, 0, 0}, &context.scratch);
  const auto known = [&](std::uint32_t v) { return usual[v][0] >= 0; };
  for (std::uint32_t v = 0; v < seen.size(); ++v)
    if ((seen[v] & bit) != 0 && beyond[v] == 0) usual[v] = colour(v);
  sweep_edges(completed_parts, context, [&](std::uint32_t from, std::uint32_t to) {
    if (!known(from) || known(to) || (seen[to] & bit) == 0) return false;
    const Rgb here = colour(to);
    const float light = here[0] + here[1] + here[2] + 1,
                usual_light = usual[from][0] + usual[from][1] + usual[from][2] + 1;
    for (std::size_t c = 0; c < 3; ++c)
      if (std::abs(here[c] - usual[from][c]) > kLevels + kShare * usual[from][c] ||
          std::abs(here[c] / light - usual[from][c] / usual_light) > kHue)
        return false;
    for (std::size_t c = 0; c < 3; ++c) usual[to][c] = kMemory * usual[from][c] + (1 - kMemory) * here[c];
    return true;
  });
  for (std::uint32_t v = 0; v < seen.size(); ++v)
    if (!known(v)) seen[v] &= std::uint8_t(~bit);
}

// Where both views see that surface and one shows it much lighter than the other does, the one that looks at
// it more slantingly looks past it.
void choose_at_limb(std::span<const std::uint8_t> beyond, std::span<const float> left_light,
                    std::span<const float> right_light, VertexViews& views,
                    std::pmr::memory_resource* memory) {
  constexpr float kUnlike = 1.25F, kSlanting = 0.25F;  // the share of the view that looks past
  std::pmr::vector<float> ratios(memory);
  ratios.reserve(beyond.size());
  for (std::size_t v = 0; v < beyond.size(); ++v)
    if (views.seen[v] == (kSeenLeft | kSeenRight) && beyond[v] == 0)
      ratios.push_back(left_light[v] / right_light[v]);
  const float usual = ratios.empty() ? 1 : float(median(ratios));
  for (std::size_t v = 0; v < beyond.size(); ++v) {
    if (views.seen[v] != (kSeenLeft | kSeenRight) || beyond[v] == 0) continue;
    const float ratio = left_light[v] / right_light[v] / usual;
    if (ratio < kUnlike && ratio > 1 / kUnlike) continue;
    if (views.share[v] > 1 - kSlanting) views.seen[v] = kSeenRight;
    if (views.share[v] < kSlanting) views.seen[v] = kSeenLeft;
  }
}

float cosine_towards(const Vec3f& camera, const Vec3f& at, const Vec3f& normal) {
  const Vec3f d = minus(camera, at);
  return length(d) > 0 ? std::max(0.0F, dot(d, normal) / length(d)) : 0;
}

bool covered(const RectifiedView& view, const RectifiedPair& pair, float x, float y) {
  const int column = int(std::lround(x));
  const int row = int(std::lround(y));
  return pair.inside(column, row) && (view.valid.empty() || view.valid[pair.index(column, row)] != 0);
}

// Everything a band of rows needs.
struct Shooting {
  const FaceMesh& mesh;
  const RectifiedPair& pair;
  const Chart& chart;
  const RowBands& bands;
  std::span<const FrontMap> maps;  // middle, left, right
  const VertexViews& views;
  std::span<const std::uint8_t> kept;
  const ShotOptions& options;
  ShotPlanes& planes;
  std::span<float> rows;      // two picture rows a band
  std::span<BoxSum> columns;  // one chart row a band
  StageContext& context;

  PhotoRow row_of(const RectifiedView& view, int band, int which) const {
    const FrontMap& map = maps[which == 0 ? 1 : 2];
    const float first = chart.view_x(map.shift, 0, 0);  // its columns are shifted by the disparity already
    const int from = int(first) - 4;
    const int to = int(first + float(map.width_px) / map.scale) + 4;
    const std::size_t size = 3 * std::size_t(pair.width_px);
    return {view,
            pair.width_px,
            pair.height_px,
            from,
            to,
            rows.subspan((2 * std::size_t(band) + std::size_t(which)) * size, size)};
  }

  void shoot_band(int band) const {
    PhotoRow left = row_of(pair.left, band, 0);
    PhotoRow right = row_of(pair.right, band, 1);
    const RowRange range = bands.rows(band);
    for (int y = range.begin; y < range.end && !context.stop(); ++y) {
      left.move_to(chart.view_y(float(y)));
      if (!options.left_only) right.move_to(chart.view_y(float(y)));
      for (int x = 0; x < chart.width_px; ++x) {
        const std::size_t k = chart.index(x, y);
        const std::uint32_t owner = maps[0].owner[k];
        if (owner != kNoTriangle && kept[owner] != 0)
          shoot_texel(k, x, y, mesh.triangles[owner], left, right);
      }
    }
  }

  void shoot_texel(std::size_t k, int x, int y, const Triangle& t, const PhotoRow& left,
                   const PhotoRow& right) const {
    const Vec2f at{float(x), float(y)};
    const float disparity = maps[0].nearest[k];
    const std::uint8_t may = views.seen[t[0]] | views.seen[t[1]] | views.seen[t[2]];
    const float row = chart.view_y(at.y);
    planes.seen[k] = kSurface;
    const auto look = [&](const RectifiedView& view, const PhotoRow& photo, const FrontMap& map,
                          std::uint8_t bit, std::span<std::uint8_t> to) {
      const float column = chart.view_x(at.x, disparity, map.side);
      float rgb[3];
      photo.read(column, rgb);
      for (std::size_t i = 0; i < 3; ++i) to[3 * k + i] = to_byte(rgb[i]);
      if ((may & bit) != 0 && covered(view, pair, column, row) &&
          map.sees(at, disparity, options.occlusion_px))
        planes.seen[k] |= bit;
    };
    look(pair.left, left, maps[1], kSeenLeft, planes.left);
    if (!options.left_only) look(pair.right, right, maps[2], kSeenRight, planes.right);
    planes.share[k] = to_byte(255 * share_at(at, t));
  }

  float share_at(const Vec2f& at, const Triangle& t) const {
    const Vec2f& a = chart.texel[t[0]];
    const Vec2f& b = chart.texel[t[1]];
    const Vec2f& c = chart.texel[t[2]];
    const float to_unit = 1 / signed_area(chart, t);
    const float wb = ((at.x - a.x) * (c.y - a.y) - (at.y - a.y) * (c.x - a.x)) * to_unit;
    const float wc = ((b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x)) * to_unit;
    return (1 - wb - wc) * views.share[t[0]] + wb * views.share[t[1]] + wc * views.share[t[2]];
  }

  // A view has its full say where all of the window around is seen by it, and none where more than a
  // tenth is not: a photograph mixes front and back on the last pixels before an occlusion.
  void feather_band(int band) const {
    const int radius = std::max(1, int(std::lround(options.feather_px * float(chart.texels_per_px))));
    const auto blind = [&](int x, int y) {
      const std::uint8_t seen = planes.seen[chart.index(x, y)];
      if ((seen & kSurface) == 0) return BoxSum{};
      return BoxSum{(seen & kSeenLeft) == 0 ? 1 : 0, (seen & kSeenRight) == 0 ? 1 : 0};
    };
    const float area = float((2 * radius + 1) * (2 * radius + 1));
    const auto say = [area](int blind_texels) {
      return to_byte(255 * (1 - 2.5F * float(blind_texels) / area));
    };
    const std::size_t width = std::size_t(chart.width_px);
    slide_box(chart.width_px, chart.height_px, radius, bands.rows(band),
              columns.subspan(std::size_t(band) * width, width), blind, [&](int x, int y, const BoxSum& sum) {
                const std::size_t k = chart.index(x, y);
                planes.say_left[k] = (planes.seen[k] & kSeenLeft) != 0 ? say(sum.first) : std::uint8_t{0};
                planes.say_right[k] = (planes.seen[k] & kSeenRight) != 0 ? say(sum.second) : std::uint8_t{0};
              });
  }
};

}  // namespace

VertexViews look_at_vertices(const FaceMesh& mesh, const RectifiedPair& pair, const Chart& chart,
                             const FrontMap& left, const FrontMap& right, const ShotOptions& options,
                             StageContext& context) {
  std::pmr::memory_resource* const memory = &context.scratch;
  const std::size_t n = mesh.vertices_mm.size();
  const Vec3d c = inverse(pair.right_from_left).translation_mm;
  const Vec3f right_camera{float(c.x), float(c.y), float(c.z)};
  VertexViews views(memory);
  views.share.resize(n);
  views.seen.resize(n);
  constexpr int kBands = 32;
  context.pool.for_each<std::size_t>(int(n), kBands, [&](std::size_t v) {
    const float towards_left = cosine_towards({}, mesh.vertices_mm[v], mesh.normals[v]);
    const float towards_right = cosine_towards(right_camera, mesh.vertices_mm[v], mesh.normals[v]);
    const float least = mesh.measured.empty() || mesh.measured[v] != 0 ? 0 : kLeastCosine;
    if (chart.placed[v] != 0) {
      if (towards_left >= least && left.sees(chart.texel[v], chart.disparity_px[v], options.occlusion_px))
        views.seen[v] |= kSeenLeft;
      if (!options.left_only && towards_right >= least &&
          right.sees(chart.texel[v], chart.disparity_px[v], options.occlusion_px))
        views.seen[v] |= kSeenRight;
    }
    if (options.left_only) return;
    const float l = std::pow(towards_left, options.angle_power);
    const float r = std::pow(towards_right, options.angle_power);
    views.share[v] = l + r > 1e-6F ? r / (l + r) : 0.5F;
  });
  if (context.stop()) return views;
  std::pmr::vector<Triangle> parts(memory);  // those that hold a vertex that was completed
  for (const Triangle& t : mesh.triangles)
    if (!mesh.measured.empty() && !all_three(mesh.measured, t)) parts.push_back(t);
  const auto beyond = completed_to_border(mesh, parts, context);
  const auto look = [&](const RectifiedView& view, float side, std::uint8_t bit, std::span<float> light) {
    const PhotoSampler photo(view.rgb, pair.width_px, pair.height_px);
    const auto colour = [&](std::uint32_t v) {
      float rgb[3];
      photo.read(chart.view_x(chart.texel[v].x, chart.disparity_px[v], side), chart.view_y(chart.texel[v].y),
                 rgb);
      return std::array<float, 3>{rgb[0], rgb[1], rgb[2]};
    };
    if (context.stop()) return;
    forget_what_lies_behind(parts, beyond, bit, colour, views.seen, context);
    if (context.stop()) return;
    context.pool.for_each<std::size_t>(int(n), kBands, [&](std::size_t v) {
      const auto rgb = colour(std::uint32_t(v));
      light[v] = rgb[0] + rgb[1] + rgb[2] + 1;
    });
  };
  std::pmr::vector<float> left_light(n, memory), right_light(n, memory);
  look(pair.left, kLeftSide, kSeenLeft, left_light);
  if (options.left_only || context.stop()) return views;
  look(pair.right, kRightSide, kSeenRight, right_light);
  if (!context.stop()) choose_at_limb(beyond, left_light, right_light, views, memory);
  return views;
}

ShotPlanes shoot(const FaceMesh& mesh, const RectifiedPair& pair, const Chart& chart, const RowBands& bands,
                 std::span<const FrontMap> maps, const VertexViews& views, std::span<const std::uint8_t> kept,
                 const ShotOptions& options, StageContext& context) {
  ShotPlanes planes{chart.pixels(), &context.scratch};
  const std::size_t band_count = std::size_t(bands.count());
  std::pmr::vector<float> rows(band_count * 6 * std::size_t(pair.width_px), 0.0F, &context.scratch);
  std::pmr::vector<BoxSum> columns(band_count * std::size_t(chart.width_px), BoxSum{}, &context.scratch);
  Shooting shooting{mesh, pair, chart, bands, maps, views, kept, options, planes, rows, columns, context};
  context.pool.for_each(bands.count(), bands.count(), [&shooting](int band) { shooting.shoot_band(band); });
  context.pool.for_each(bands.count(), bands.count(), [&shooting](int band) {
    if (!shooting.context.stop()) shooting.feather_band(band);
  });
  return planes;
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/chart/chart.h"

#include <algorithm>
#include <cmath>

#include "hal/base/groups.h"
#include "pipeline/mesh/triangle_raster.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr float kSameWay = 0.5F;  // cosine: a chart's triangles face within 60 degrees of its first
constexpr float kPaddingPx = 2;
constexpr double kFilledPxPerMm = 1;

struct Piece {
  std::uint32_t first, count;
  bool photographed;
  float width, height, x, y;
};  // of a chart; x and y: its place

Vec3f normal_of(const FaceMesh& mesh, std::uint32_t triangle) {
  const auto& t = mesh.triangles[triangle];
  const Vec3f& a = mesh.vertices_mm[t[0]];
  return unit(cross(minus(mesh.vertices_mm[t[1]], a), minus(mesh.vertices_mm[t[2]], a)));
}

// The plane a chart is laid flat on: across and down in millimetres, and where it is taken already.
class FlatSide {
 public:
  explicit FlatSide(std::pmr::memory_resource* memory)
      : taken_by_(std::size_t(kSide) * std::size_t(kSide), 0, memory) {}

  // Down the picture stays down, so that charts are as high as they are wide or higher.
  void turn_to(const Vec3f& axis, const Vec3f& middle) {
    across_ = cross(Vec3f{0, 1, 0}, axis);
    across_ = dot(across_, across_) > 1e-6F ? unit(across_) : Vec3f{1, 0, 0};
    down_ = cross(axis, across_);
    middle_ = on_it(middle);
    ++chart_;
  }
  Vec2f on_it(const Vec3f& p) const { return {dot(p, across_), dot(p, down_)}; }

  // False where something of this chart lies there: what faces one way within 60 degrees may still lie before
  // itself, as the lip of a nostril before its floor. So far from its first triangle that it is not known,
  // too. Triangles smaller than a place of the plane may slip through.
  bool take(const FaceMesh& mesh, const Triangle& t) {
    Vec2f at[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2f p = on_it(mesh.vertices_mm[t[k]]);
      at[k] = {(p.x - middle_.x) * kPerMm + kSide / 2, (p.y - middle_.y) * kPerMm + kSide / 2};
    }
    if (std::ranges::any_of(at, [](const Vec2f& p) {
          return !(p.x >= 0 && p.y >= 0 && p.x <= kSide - 1 && p.y <= kSide - 1);
        }))
      return false;
    const Vec2f centre{(at[0].x + at[1].x + at[2].x) / 3, (at[0].y + at[1].y + at[2].y) / 3};
    for (Vec2f& p : at)  // neighbours share an edge
      p = {centre.x + kWithin * (p.x - centre.x), centre.y + kWithin * (p.y - centre.y)};
    bool free = true;
    const auto for_each_place = [&](auto&& work) {
      for_each_texel(at[0], at[1], at[2], kSide, {0, kSide}, [&](int x, int y, float, float, float) {
        work(taken_by_[std::size_t(y) * std::size_t(kSide) + std::size_t(x)]);
      });
    };
    for_each_place([&](std::uint32_t& by) { free = free && by != chart_; });
    if (free) for_each_place([&](std::uint32_t& by) { by = chart_; });
    return free;
  }

 private:
  static constexpr int kSide = 1200;
  static constexpr float kPerMm = 4, kWithin = 0.9F;
  std::pmr::vector<std::uint32_t> taken_by_;  // the last chart, from 1
  std::uint32_t chart_ = 0;
  Vec3f across_, down_;
  Vec2f middle_;
};

class Builder {
 public:
  Builder(const FaceMesh& mesh, std::span<const std::uint8_t> kept,
          std::span<const std::uint8_t> photographed, std::pmr::memory_resource* memory)
      : mesh_(mesh),
        photographed_(photographed),
        around_(memory),
        taken_(kept.begin(), kept.end(), memory),
        plane_(memory),
        pieces_(memory) {
    around_.sort(mesh.vertices_mm.size(), [&](auto&& add) {
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        if (kept[t] == 0)
          for (const std::uint32_t v : mesh.triangles[t]) add(v, t);
    });
  }

  std::pmr::vector<Piece>& grow_all(SideCharts& sides) {
    sides.triangles.reserve(around_.members() / 3);
    sides.corner.reserve(around_.members());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (taken_[t] == 0) grow(t, sides);
    return pieces_;
  }

 private:
  bool seen(std::uint32_t triangle) const { return all_three(photographed_, mesh_.triangles[triangle]); }

  // A chart around one triangle, laid flat in millimetres with its upper left corner at zero.
  void grow(std::uint32_t seed, SideCharts& sides) {
    const Vec3f axis = normal_of(mesh_, seed);
    const bool photograph = seen(seed);
    const std::size_t from = sides.triangles.size();
    plane_.turn_to(axis, mesh_.vertices_mm[mesh_.triangles[seed][0]]);
    plane_.take(mesh_, mesh_.triangles[seed]);
    taken_[seed] = 1;
    sides.triangles.push_back(seed);
    for (std::size_t next = from; next < sides.triangles.size(); ++next) {
      const auto& t = mesh_.triangles[sides.triangles[next]];
      for (const std::uint32_t v : t)
        for (const std::uint32_t other : around_[v]) {
          const auto shared = [&](std::uint32_t corner) {
            return std::ranges::count(mesh_.triangles[other], corner) > 0;
          };
          if (taken_[other] != 0 || seen(other) != photograph || std::ranges::count_if(t, shared) < 2)
            continue;  // they share no edge
          if (dot(normal_of(mesh_, other), axis) < kSameWay || !plane_.take(mesh_, mesh_.triangles[other]))
            continue;
          taken_[other] = 1;
          sides.triangles.push_back(other);
        }
    }
    lay_flat(from, photograph, sides);
  }

  void lay_flat(std::size_t from, bool photograph, SideCharts& sides) {
    Vec2f low{1e30F, 1e30F};
    Vec2f high{-1e30F, -1e30F};
    for (std::size_t k = from; k < sides.triangles.size(); ++k)
      for (const std::uint32_t v : mesh_.triangles[sides.triangles[k]]) {
        const Vec2f at = plane_.on_it(mesh_.vertices_mm[v]);
        sides.corner.push_back(at);
        low = {std::min(low.x, at.x), std::min(low.y, at.y)};
        high = {std::max(high.x, at.x), std::max(high.y, at.y)};
      }
    for (std::size_t k = 3 * from; k < sides.corner.size(); ++k)
      sides.corner[k] = {sides.corner[k].x - low.x, sides.corner[k].y - low.y};
    pieces_.push_back({std::uint32_t(from), std::uint32_t(sides.triangles.size() - from), photograph,
                       high.x - low.x, high.y - low.y, 0, 0});
  }

  const FaceMesh& mesh_;
  std::span<const std::uint8_t> photographed_;
  Groups around_;  // side triangles around each vertex
  std::pmr::vector<std::uint8_t> taken_;
  FlatSide plane_;
  std::pmr::vector<Piece> pieces_;
};

struct Scale {
  float photographed, filled;  // texels a millimetre
  float of(const Piece& p) const { return p.photographed ? photographed : filled; }
};

// Columns of charts, the widest first; returns the width they take. What is higher than the room is pressed
// in.
float pack(std::span<Piece> pieces, const Scale& scale, float height_px) {
  float column_x = 0;
  float column_width = 0;
  float y = 0;
  for (Piece& p : pieces) {
    const float s = scale.of(p);
    const float width = p.width * s + 1 + 2 * kPaddingPx;
    const float height = std::min(p.height * s + 1 + 2 * kPaddingPx, height_px);
    if (y + height > height_px) {
      column_x += std::ceil(column_width);
      column_width = y = 0;
    }
    p.x = column_x + kPaddingPx;
    p.y = y + kPaddingPx;
    y += std::ceil(height);
    column_width = std::max(column_width, width);
  }
  return column_x + std::ceil(column_width);
}

}  // namespace

SideCharts lay_out_sides(const FaceMesh& mesh, const Chart& main, std::span<const std::uint8_t> kept,
                         std::span<const std::uint8_t> photographed, double photograph_px_per_mm, int max_px,
                         std::pmr::memory_resource* memory) {
  SideCharts sides(memory);
  if (std::ranges::all_of(kept, [](std::uint8_t k) { return k != 0; })) return sides;
  Builder builder(mesh, kept, photographed, memory);
  auto& pieces = builder.grow_all(sides);
  std::ranges::sort(pieces, [](const Piece& a, const Piece& b) {
    return a.width != b.width ? a.width > b.width : a.first < b.first;
  });

  // Halved until all of it finds room; a chart's extent has a limit, however far away a vertex is.
  const float room = float(max_px - main.width_px);
  const float high = float(main.height_px);
  Scale scale{float(photograph_px_per_mm), float(kFilledPxPerMm)};
  float width = pack(pieces, scale, high);
  for (int round = 0; width > room && round < 24; ++round) {
    scale = {scale.photographed / 2, scale.filled / 2};
    width = pack(pieces, scale, high);
  }
  const float squeeze = width > room ? room / width : 1;  // thousands of crumbs: they share texels
  for (const Piece& p : pieces) {
    const float s = scale.of(p);
    const float tall = std::min(s, (high - 1 - 2 * kPaddingPx) / std::max(p.height, 1e-3F));
    for (std::size_t k = 3 * std::size_t{p.first}; k < 3 * (std::size_t{p.first} + p.count); ++k) {
      Vec2f& at = sides.corner[k];
      at = {float(main.width_px) + (p.x + at.x * s) * squeeze, p.y + at.y * tall};
    }
  }
  sides.width_px = int(std::ceil(std::min(width, room)));
  return sides;
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/head_texturer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory_resource>
#include <numeric>
#include <vector>

#include "pipeline/fuse/level_grid.h"
#include "pipeline/fuse/pose_registration.h"
#include "pipeline/mesh/triangle_raster.h"
#include "pipeline/model/photo_sampler.h"
#include "pipeline/model/vector3.h"
#include "pipeline/texture/chart/chart.h"
#include "pipeline/texture/colour_fill.h"

namespace relievo::pipeline {
namespace {

constexpr int kDepthShare = 2;               // pixels of a photograph a place of its depth map, each way
constexpr float kHiddenMm = 2.5F;            // behind what the map says: hidden
constexpr float kLeastCosine = 0.17F;        // 80 degrees: not looked at
constexpr float kFadeEdge = 0.12F;           // of a view's say, lost an edge nearer to where it ends ...
constexpr int kFadeEdges = 8;                // ... over so many edges
constexpr float kOthersOnCompleted = 0.05F;  // say of other poses where the master completed what it saw
constexpr float kOwnMm = 3;                  // from what its own pair measured: the same skin
constexpr float kBesideMm = 4;               // once to three times that from a place: around it
constexpr float kMasterLevel = 20;           // the others are brought to the master's level
constexpr float kMasterFirst = 1.8F;         // the master's say before others that look as straight
constexpr float kBorderPx = 3;
constexpr std::size_t kMostViews = 2 * kMostPoses;

// By how much the best view wins: the twelfth power of a view's say to the best one's. Below kLeastShare it
// is less than kNothing.
constexpr float kNothing = 0.01F, kLeastShare = 0.68F;

class Texturing {
 public:
  Texturing(const FaceMesh& mesh, std::size_t closing, std::span<const HeadView> views, StageContext& context)
      : mesh_(mesh), closing_(closing), views_(views), context_(context) {}

  Result<TextureAtlas> run(int max_atlas_px) {
    look_from_all();
    if (context_.stop()) return stopped();
    for (std::size_t v = 0; v < vertices_; ++v)
      for (std::size_t i = 0; i < views_.size(); ++i) known_[v] = known_[v] != 0 || say(v, i) > 0 ? 1 : 0;
    even_out();
    if (context_.stop()) return stopped();
    lay_out(max_atlas_px);
    shade();
    if (context_.stop()) return stopped();
    context_.pool.for_each<std::size_t>(int(vertices_), kBands, [&](std::size_t v) {
      if (known_[v] != 0) colours_[v] = blend_at(v);
    });
    fill_colours(mesh_, known_, colours_, context_);
    paint_filled();
    constexpr int kMarginPx = 8;
    continue_outwards(atlas_, kMarginPx, &context_.scratch);
    write_vertex_colours(colours_, atlas_);
    return std::move(atlas_);
  }

 private:
  static constexpr int kBands = 32;
  float say(std::size_t vertex, std::size_t view) const { return say_[view * vertices_ + vertex]; }
  const VertexColour& level(std::size_t vertex, std::size_t view) const {
    return level_[view * vertices_ + vertex];
  }

  // x and y are pixels.
  static Vec3f project(const HeadView& view, const Vec3f& place) {
    const Vec3d p = apply(view.view_from_head, wide(place));
    return {float(view.focal_px * p.x / p.z + view.centre_px.x),
            float(view.focal_px * p.y / p.z + view.centre_px.y), float(p.z)};
  }

  // Rectified, a photograph has edges within the picture.
  static bool covers(const HeadView& view, const Vec3f& p) {
    for (const float dy : {-kBorderPx, kBorderPx})
      for (const float dx : {-kBorderPx, kBorderPx}) {
        const std::size_t k = std::size_t(p.y + dy) * std::size_t(view.width_px) + std::size_t(p.x + dx);
        if (!is_photographed(view.rgb, k)) return false;
      }
    return true;
  }

  // What looking from one view takes.
  struct Room {
    Room(std::size_t places, std::size_t vertices, std::pmr::memory_resource* memory)
        : depth(places, 0.0F, memory), pixel(vertices, Vec3f{}, memory), share(vertices, 0.0F, memory) {}
    std::pmr::vector<float> depth;
    std::pmr::vector<Vec3f> pixel;
    std::pmr::vector<float> share;
  };

  // As many views at once as there are threads, so that no more rooms are needed: work(view, room). The arena
  // is for one thread: what a room needs is made before.
  std::size_t views_at_once() const { return std::min(views_.size(), std::size_t(context_.pool.size())); }
  template <typename Work>
  void for_each_view(Work&& work) const {
    for (std::size_t first = 0; first < views_.size(); first += views_at_once()) {
      const int count = int(std::min(views_at_once(), views_.size() - first));
      context_.pool.for_each(count, count, [&](int room) {
        if (!context_.stop()) work(first + std::size_t(room), std::size_t(room));
      });
    }
  }

  void look_from_all() {
    const Arena::Mark mark(context_.scratch);
    std::size_t places = 0;
    for (const HeadView& view : views_)
      places = std::max(places,
                        std::size_t(view.width_px / kDepthShare) * std::size_t(view.height_px / kDepthShare));
    std::pmr::vector<Room> rooms(&context_.scratch);
    rooms.reserve(views_at_once());
    while (rooms.size() < views_at_once()) rooms.emplace_back(places, vertices_, &context_.scratch);
    for_each_view([&](std::size_t i, std::size_t room) { look(i, rooms[room]); });
  }

  // How well a photograph looks at every vertex.
  void look(std::size_t i, Room& room) {
    const HeadView& view = views_[i];
    const int w = view.width_px / kDepthShare, h = view.height_px / kDepthShare;
    room.depth.assign(std::size_t(w) * std::size_t(h), 1e9F);
    for (std::size_t v = 0; v < vertices_; ++v) room.pixel[v] = project(view, mesh_.vertices_mm[v]);
    for (const auto& t : mesh_.triangles) {
      const auto corner = [&](std::size_t k) {
        return Vec2f{room.pixel[t[k]].x / kDepthShare, room.pixel[t[k]].y / kDepthShare};
      };
      for_each_texel(
          corner(0), corner(1), corner(2), w, {0, h}, [&](int x, int y, float a, float b, float c) {
            float& d = room.depth[std::size_t(y) * std::size_t(w) + std::size_t(x)];
            d = std::min(d, a * room.pixel[t[0]].z + b * room.pixel[t[1]].z + c * room.pixel[t[2]].z);
          });
    }
    const Vec3d eye = apply(inverse(view.view_from_head), Vec3d{0, 0, 0});
    for (std::size_t v = 0; v < closing_; ++v) {
      const Vec3f& p = room.pixel[v];
      if (!(p.z > 0) || p.x < kBorderPx || p.y < kBorderPx || p.x > float(view.width_px) - kBorderPx - 1 ||
          p.y > float(view.height_px) - kBorderPx - 1 || !covers(view, p))
        continue;
      const Vec3d to_eye = unit(minus(eye, wide(mesh_.vertices_mm[v])));
      const float cosine = float(dot(to_eye, wide(mesh_.normals[v])));
      if (cosine <= kLeastCosine) continue;
      const std::size_t x = std::size_t(std::min(int(p.x) / kDepthShare, w - 1)),
                        y = std::size_t(std::min(int(p.y) / kDepthShare, h - 1));
      if (p.z > room.depth[y * std::size_t(w) + x] + kHiddenMm / cosine) continue;
      if (!view.master && !is_own(view, mesh_.vertices_mm[v])) continue;
      float here = cosine - kLeastCosine;
      if (view.master) here *= kMasterFirst;
      if (!view.master && mesh_.measured[v] == 0) here *= kOthersOnCompleted;
      say_[i * vertices_ + v] = here;
    }
    fade(i, room.share);
  }

  // Whether the photograph's own pair measured skin there or around. Elsewhere, where the surface is a little
  // too large, the photograph shows what lies behind the head.
  static bool is_own(const HeadView& view, const Vec3f& place) {
    if (view.pose == nullptr) return true;
    const Vec3f at = narrow(apply(view.pose_from_head, wide(place)));
    const auto own = view.pose->look(at);
    if (own && std::abs(dot(own->normal, minus(at, own->at_mm))) < kOwnMm) return true;
    const auto is_beside = [&](float x, float y) {
      for (float mm = kBesideMm; mm <= 3 * kBesideMm; mm += kBesideMm)
        if (const auto hit = view.pose->look({at.x + x * mm, at.y + y * mm, at.z});
            hit && std::abs(hit->at_mm.z - at.z) < 2 * mm)
          return true;
      return false;
    };
    return (is_beside(-1, 0) && is_beside(1, 0)) || (is_beside(0, -1) && is_beside(0, 1));
  }

  // Towards where a view ends, or something hides the head from it.
  void fade(std::size_t i, std::pmr::vector<float>& share) {
    for (std::size_t v = 0; v < vertices_; ++v) share[v] = say(v, i) > 0 ? 1 : 0;
    for (int round = 0; round < kFadeEdges; ++round)
      for (const auto& t : mesh_.triangles) {
        const float least = std::min({share[t[0]], share[t[1]], share[t[2]]}) + kFadeEdge;
        for (const std::uint32_t v : t) share[v] = std::min(share[v], least);
      }
    for (std::size_t v = 0; v < vertices_; ++v) say_[i * vertices_ + v] *= share[v];
  }

  VertexColour read(std::size_t view, const Vec3f& p) const {
    const HeadView& v = views_[view];
    VertexColour rgb{};
    const float x = std::clamp(p.x, 0.0F, float(v.width_px - 1) - 1e-3F),
                y = std::clamp(p.y, 0.0F, float(v.height_px - 1) - 1e-3F);
    const std::size_t w = std::size_t(v.width_px), k = std::size_t(y) * w + std::size_t(x);
    float wx[4], wy[4];
    cubic_weights(x - std::floor(x), wx);
    cubic_weights(y - std::floor(y), wy);
    if (x < 1 || y < 1 || x >= float(v.width_px - 3) || y >= float(v.height_px - 3)) {
      for (std::size_t c = 0; c < 3; ++c) rgb[c] = float(v.rgb[3 * k + c]);
      return rgb;
    }
    std::array<float, 12> columns{};
    for (std::size_t r = 0; r < 4; ++r) {
      const std::uint8_t* row = &v.rgb[3 * (k + r * w - w - 1)];
      for (std::size_t j = 0; j < columns.size(); ++j) columns[j] += wy[r] * float(row[j]);
    }
    for (std::size_t j = 0; j < columns.size(); ++j) rgb[j % 3] += wx[j / 3] * columns[j];
    return rgb;
  }

  // Every photograph's slowly varying difference from the mean of all that see the same skin.
  void even_out() {
    std::pmr::vector<VertexColour> mean(vertices_, VertexColour{}, &context_.scratch);
    std::pmr::vector<float> weight(vertices_, 0.0F, &context_.scratch);
    context_.pool.for_each<std::size_t>(int(vertices_), kBands, [&](std::size_t v) {
      for (std::size_t i = 0; i < views_.size(); ++i) {
        if (say(v, i) <= 0) continue;
        const float w = say(v, i) * (views_[i].master ? kMasterLevel : 1);
        level_[i * vertices_ + v] = read(i, project(views_[i], mesh_.vertices_mm[v]));
        for (std::size_t c = 0; c < 3; ++c) mean[v][c] += w * level_[i * vertices_ + v][c];
        weight[v] += w;
      }
    });
    std::pmr::vector<LevelGrid> grids(&context_.scratch);
    grids.reserve(views_at_once());
    while (grids.size() < views_at_once()) grids.emplace_back(mesh_, &context_.scratch);
    for_each_view([&](std::size_t i, std::size_t room) {
      LevelGrid& grid = grids[room];
      grid.clear();
      for (std::size_t v = 0; v < vertices_; ++v) {
        if (say(v, i) <= 0) continue;
        VertexColour difference;
        for (std::size_t c = 0; c < 3; ++c)
          difference[c] = mean[v][c] / weight[v] - level_[i * vertices_ + v][c];
        grid.add(mesh_.vertices_mm[v], difference, say(v, i));
      }
      grid.smooth();
      for (std::size_t v = 0; v < vertices_; ++v) level_[i * vertices_ + v] = grid.at(mesh_.vertices_mm[v]);
    });
  }

  void lay_out(int max_px) {
    const std::pmr::vector<std::uint8_t> none(mesh_.triangles.size(), 0, &context_.scratch);
    Chart empty(&context_.scratch);
    empty.height_px = max_px / 2;
    const HeadView& master = views_.front();
    double depth = 0;
    for (const Vec3f& v : mesh_.vertices_mm) depth += apply(master.view_from_head, wide(v)).z;
    const double px_per_mm = master.focal_px * double(vertices_) / depth;
    sides_ = lay_out_sides(mesh_, empty, none, known_, px_per_mm, max_px, &context_.scratch);
    atlas_.width_px = std::max(sides_.width_px, 1);
    atlas_.height_px = empty.height_px;
    atlas_.rgb.assign(3 * atlas_.pixels(), 0);
    atlas_.origin.assign(atlas_.pixels(), kNoSurfaceTexel);
    atlas_.uv.resize(3 * mesh_.triangles.size());
    for (std::size_t s = 0; s < sides_.triangles.size(); ++s)
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec2f& at = sides_.corner[3 * s + k];
        atlas_.uv[3 * std::size_t{sides_.triangles[s]} + k] = {(at.x + 0.5F) / float(atlas_.width_px),
                                                               (at.y + 0.5F) / float(atlas_.height_px)};
      }
  }

  // Bands of rows: a texel on two triangles' edge is painted in their order, whoever paints it.
  void shade() {
    context_.pool.for_each_band(atlas_.height_px, kBands, [&](int begin, int end, int) {
      for (std::size_t s = 0; s < sides_.triangles.size() && !context_.stop(); ++s)
        shade_triangle(s, {begin, end});
    });
  }

  void shade_triangle(std::size_t s, RowRange rows) {
    const auto [low, high] =
        std::minmax({sides_.corner[3 * s].y, sides_.corner[3 * s + 1].y, sides_.corner[3 * s + 2].y});
    if (high < float(rows.begin) - 1 || low > float(rows.end)) return;
    const auto& t = mesh_.triangles[sides_.triangles[s]];
    if (!all_three(known_, t)) return;
    // Views that see all of it; where none does, those that see a corner. Whose say is nothing beside the
    // best one's all over it is left out.
    std::array<std::size_t, kMostViews> list{};
    std::array<std::array<Vec3f, 3>, kMostViews> corners;
    std::array<float, kMostViews> most{};
    std::size_t count = 0;
    float best = 0;
    for (const bool all : {true, false}) {
      for (std::size_t i = 0; i < views_.size(); ++i) {
        const auto [least, largest] = std::minmax({say(t[0], i), say(t[1], i), say(t[2], i)});
        if ((all ? least : largest) <= 0) continue;
        list[count++] = i;
        most[i] = largest;
        best = std::max(best, least);
      }
      if (count > 0) break;
    }
    const auto end = std::remove_if(list.begin(), list.begin() + std::ptrdiff_t(count),
                                    [&](std::size_t i) { return most[i] < kLeastShare * best; });
    count = std::size_t(end - list.begin());
    for (const std::size_t i : std::span(list.data(), count))
      for (std::size_t k = 0; k < 3; ++k) corners[i][k] = project(views_[i], mesh_.vertices_mm[t[k]]);
    for_each_texel(sides_.corner[3 * s], sides_.corner[3 * s + 1], sides_.corner[3 * s + 2], atlas_.width_px,
                   rows, [&](int x, int y, float a, float b, float c) {
                     // So small a triangle is seen as if from far away.
                     const auto pixel = [&](std::size_t i) {
                       const auto& [p, q, r] = corners[i];
                       return Vec3f{a * p.x + b * q.x + c * r.x, a * p.y + b * q.y + c * r.y, 1};
                     };
                     const auto mean = [&](std::size_t i) {
                       return a * say(t[0], i) + b * say(t[1], i) + c * say(t[2], i);
                     };
                     const Blend blend =
                         mix(std::span(list.data(), count), mean, pixel, [&](std::size_t i, std::size_t k) {
                           return a * level(t[0], i)[k] + b * level(t[1], i)[k] + c * level(t[2], i)[k];
                         });
                     const std::size_t at = atlas_.index(x, y);
                     for (std::size_t k = 0; k < 3; ++k) atlas_.rgb[3 * at + k] = to_byte(blend.rgb[k]);
                     atlas_.origin[at] = std::uint8_t(kLeftPhotographTexel + std::lround(253 * blend.right));
                   });
  }

  struct Blend {
    VertexColour rgb{};
    float right = 0;
  };
  template <typename Say, typename At, typename Level>
  Blend mix(std::span<const std::size_t> list, Say&& say_of, At&& pixel_of, Level&& level_of) const {
    float best = 1e-9F;
    for (const std::size_t i : list) best = std::max(best, say_of(i));
    Blend blend;
    float weight = 0;
    for (const std::size_t i : list) {
      const float share = std::max(say_of(i), 0.0F) / best, third = share * share * share;
      const float w = third * third * third * third;
      if (w < kNothing) continue;
      const VertexColour rgb = read(i, pixel_of(i));
      for (std::size_t k = 0; k < 3; ++k) blend.rgb[k] += w * (rgb[k] + level_of(i, k));
      blend.right += views_[i].right ? w : 0;
      weight += w;
    }
    for (float& c : blend.rgb) c /= weight;
    blend.right = std::clamp(blend.right / weight, 0.0F, 1.0F);
    return blend;
  }

  VertexColour blend_at(std::size_t v) const {
    std::array<std::size_t, kMostViews> all{};
    std::iota(all.begin(), all.end(), std::size_t{0});
    const auto pixel = [&](std::size_t i) { return project(views_[i], mesh_.vertices_mm[v]); };
    return mix(
               std::span(all.data(), views_.size()), [&](std::size_t i) { return say(v, i); }, pixel,
               [&](std::size_t i, std::size_t k) { return level(v, i)[k]; })
        .rgb;
  }

  void paint_filled() {
    for (std::size_t s = 0; s < sides_.triangles.size(); ++s)
      if (const Triangle& t = mesh_.triangles[sides_.triangles[s]]; !all_three(known_, t))
        fill_triangle(sides_.corner[3 * s], sides_.corner[3 * s + 1], sides_.corner[3 * s + 2], t, colours_,
                      atlas_.width_px, atlas_);
  }

  const FaceMesh& mesh_;
  std::size_t closing_;
  std::span<const HeadView> views_;
  StageContext& context_;
  std::size_t vertices_{mesh_.vertices_mm.size()};
  // A view and vertex: 0 where it is not seen.
  std::pmr::vector<float> say_{vertices_ * views_.size(), 0.0F, &context_.scratch};
  // A view and vertex: what is added to the photograph.
  std::pmr::vector<VertexColour> level_{vertices_ * views_.size(), VertexColour{}, &context_.scratch};
  // A vertex: 1 where any view sees it.
  std::pmr::vector<std::uint8_t> known_{vertices_, 0, &context_.scratch};
  std::pmr::vector<VertexColour> colours_{vertices_, VertexColour{}, &context_.scratch};
  SideCharts sides_{&context_.scratch};
  TextureAtlas atlas_{&context_.output};
};

}  // namespace

Result<TextureAtlas> texture_head(const FaceMesh& mesh, std::size_t closing, std::span<const HeadView> views,
                                  int max_atlas_px, StageContext& context) {
  if (views.empty() || views.size() > kMostViews || mesh.triangles.empty())
    return invalid("no photograph, too many, or no surface");
  return Texturing(mesh, closing, views, context).run(max_atlas_px);
}

}  // namespace relievo::pipeline

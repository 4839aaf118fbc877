// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/colour_fill.h"

#include <algorithm>
#include <cmath>

#include "hal/base/groups.h"
#include "pipeline/base/parts.h"
#include "pipeline/mesh/triangle_raster.h"
#include "pipeline/model/photo_sampler.h"

namespace relievo::pipeline {
namespace {

// There and back. A hole is smooth long before; a whole completed head gets as many as there is time for.
constexpr int kFewestSweeps = 10, kMostSweeps = 40;
constexpr std::size_t kSweptVertices = 1'500'000;
constexpr float kStill = 0.25F;          // grey levels: nothing moves by more
constexpr float kOverRelaxation = 1.6F;  // Young's successive over-relaxation; below 2 it converges

// Unknown vertices in the order in which the known ones reach them, coloured by those that came before.
std::pmr::vector<std::uint32_t> reach(std::span<const std::uint8_t> known, const Groups& neighbours,
                                      std::span<VertexColour> colours, std::pmr::memory_resource* memory) {
  std::pmr::vector<std::uint8_t> done(known.begin(), known.end(), memory);
  std::pmr::vector<std::uint32_t> order(memory);
  order.reserve(std::size_t(std::ranges::count(known, std::uint8_t{0})));
  const auto take = [&](std::uint32_t v) {
    VertexColour sum{0, 0, 0};
    float count = 0;
    for (const std::uint32_t n : neighbours[v]) {
      if (done[n] != 1) continue;
      for (std::size_t c = 0; c < 3; ++c) sum[c] += colours[n][c];
      count += 1;
    }
    if (count == 0) return;
    colours[v] = {sum[0] / count, sum[1] / count, sum[2] / count};
    done[v] = 2;  // not yet a neighbour for its own ring
    order.push_back(v);
  };
  for (std::uint32_t v = 0; v < known.size(); ++v)
    if (done[v] == 0) take(v);
  for (std::size_t next = 0; next < order.size();) {
    const std::size_t ring_end = order.size();
    for (std::size_t i = next; i < ring_end; ++i) done[order[i]] = 1;
    for (; next < ring_end; ++next)
      for (const std::uint32_t n : neighbours[order[next]])
        if (done[n] == 0) take(n);
  }
  return order;
}

// Of the `count` colours those that are used; grey where there are none. colour(k, channel).
template <typename Used, typename Colour>
std::array<double, 3> mean_of(std::size_t count, const Used& used, const Colour& colour) {
  std::array<double, 3> sum{0, 0, 0};
  double n = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (!used(k)) continue;
    for (std::size_t c = 0; c < 3; ++c) sum[c] += double(colour(k, c));
    n += 1;
  }
  if (n == 0) return {128, 128, 128};
  return {sum[0] / n, sum[1] / n, sum[2] / n};
}

}  // namespace

void fill_colours(const FaceMesh& mesh, std::span<const std::uint8_t> known, std::span<VertexColour> colours,
                  StageContext& context) {
  const auto mean = mean_of(
      known.size(), [&](std::size_t v) { return known[v] != 0; },
      [&](std::size_t v, std::size_t c) { return colours[v][c]; });
  for (std::size_t v = 0; v < known.size(); ++v)
    if (known[v] == 0) colours[v] = {float(mean[0]), float(mean[1]), float(mean[2])};
  if (std::ranges::find(known, std::uint8_t{1}) == known.end()) return;
  // Of the unknown vertices, each as often as triangles say so: twice inside, once at an edge.
  Groups neighbours(&context.scratch);
  neighbours.sort(mesh.vertices_mm.size(), [&](auto&& add) {
    for (const auto& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        if (known[t[i]] == 0) add(t[i], t[(i + 1) % 3]), add(t[i], t[(i + 2) % 3]);
  });
  const std::pmr::vector<std::uint32_t> order = reach(known, neighbours, colours, &context.scratch);
  float moved = 0;
  const auto relax = [&](std::uint32_t v) {
    const auto around = neighbours[v];
    const float share = 1 / float(around.size());
    for (std::size_t c = 0; c < 3; ++c) {
      float sum = 0;
      for (const std::uint32_t n : around) sum += colours[n][c];
      const float step = kOverRelaxation * (sum * share - colours[v][c]);
      colours[v][c] += step;
      moved = std::max(moved, std::abs(step));
    }
  };
  // What is known travels all the way in from either side.
  const int sweeps = std::clamp(int(kSweptVertices / (order.size() + 1)), kFewestSweeps, kMostSweeps);
  for (int sweep = 0; sweep < sweeps && !context.stop(); ++sweep) {
    moved = 0;
    for (const std::uint32_t v : order) relax(v);
    for (std::size_t i = order.size(); i > 0; --i) relax(order[i - 1]);
    if (moved < kStill) break;
  }
}

void fill_triangle(const Vec2f& a, const Vec2f& b, const Vec2f& c, const Triangle& t,
                   std::span<const VertexColour> colours, int width_px, TextureAtlas& atlas) {
  for_each_texel(a, b, c, width_px, {0, atlas.height_px}, [&](int x, int y, float wa, float wb, float wc) {
    const std::size_t at = atlas.index(x, y);
    if (atlas.origin[at] >= kLeftPhotographTexel) return;
    for (std::size_t i = 0; i < 3; ++i)
      atlas.rgb[3 * at + i] = to_byte(wa * colours[t[0]][i] + wb * colours[t[1]][i] + wc * colours[t[2]][i]);
    atlas.origin[at] = kFilledTexel;
  });
}

void write_vertex_colours(std::span<const VertexColour> colours, TextureAtlas& atlas) {
  atlas.vertex_rgb.reserve(3 * colours.size());
  for (const VertexColour& colour : colours)
    for (const float c : colour) atlas.vertex_rgb.push_back(to_byte(c));
}

void continue_outwards(TextureAtlas& atlas, int margin_px, std::pmr::memory_resource* memory) {
  constexpr int kInside = 2;  // texels
  const std::size_t size = atlas.origin.size();
  const auto beside = [&](std::size_t k, const auto& visit) {
    for_each_beside(k, std::size_t(atlas.width_px), size, visit);
  };
  enum : std::uint8_t { kOutside, kInner, kRim, kNear, kReached };
  std::pmr::vector<std::uint8_t> state(size, kOutside, memory);
  for (std::size_t k = 0; k < size; ++k) state[k] = atlas.origin[k] != kNoSurfaceTexel ? kInner : kOutside;
  struct Step {
    std::uint32_t at, from;
  };
  std::pmr::vector<Step> steps(memory);
  steps.reserve(2 * size);  // inwards once and outwards once; what is never visited costs nothing
  const auto put = [&](std::size_t at, std::size_t from) {
    steps.push_back({std::uint32_t(at), std::uint32_t(from)});
  };
  for (std::size_t k = 0; k < size; ++k) {
    bool open = false;
    if (state[k] == kInner) beside(k, [&](std::size_t n) { open = open || state[n] == kOutside; });
    if (open) put(k, k);
  }
  std::size_t begin = 0;
  const auto next_ring = [&](auto&& visit) {
    const std::size_t end = steps.size();
    for (; begin < end; ++begin)
      beside(steps[begin].at, [&, from = steps[begin].from](std::size_t n) { visit(n, from); });
  };
  for (const Step& s : steps) state[s.at] = kRim;
  for (int step = 0; step < kInside; ++step)  // inwards, the last ring being the first of clean colours
    next_ring([&](std::size_t n, std::size_t) {
      if (state[n] != kInner) return;
      state[n] = step + 1 < kInside ? kRim : kReached;
      put(n, n);
    });
  // What is too thin for such a ring goes on from its own rim.
  std::pmr::vector<std::size_t> near(memory);
  near.reserve(steps.size());
  for (std::size_t i = begin; i < steps.size(); ++i) near.push_back(steps[i].at);
  std::size_t looked_at = 0;
  for (int step = 0; step < kInside + margin_px; ++step)
    for (const std::size_t end = near.size(); looked_at < end; ++looked_at)
      beside(near[looked_at], [&](std::size_t n) {
        if (state[n] == kRim) state[n] = kNear, near.push_back(n);
      });
  for (std::size_t k = 0; k < size; ++k)
    if (state[k] == kRim) state[k] = kReached, put(k, k);
  for (int step = 0; step < kInside + margin_px; ++step)
    next_ring([&](std::size_t n, std::size_t from) {
      if (state[n] != kNear && state[n] != kOutside) return;
      state[n] = kReached;
      put(n, from);
    });
  const auto on_surface = [&](std::size_t k) { return atlas.origin[k] != kNoSurfaceTexel; };
  const auto mean =
      mean_of(size, on_surface, [&](std::size_t k, std::size_t c) { return atlas.rgb[3 * k + c]; });
  for (std::size_t k = 0; k < size; ++k)
    for (std::size_t c = 0; c < 3 && !on_surface(k); ++c) atlas.rgb[3 * k + c] = std::uint8_t(mean[c]);
  for (const Step& s : steps)
    if (atlas.origin[s.at] == kNoSurfaceTexel)
      std::copy_n(&atlas.rgb[3 * std::size_t{s.from}], 3, &atlas.rgb[3 * std::size_t{s.at}]);
}

}  // namespace relievo::pipeline

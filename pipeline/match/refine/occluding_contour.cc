// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/refine/occluding_contour.h"

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <optional>
#include <vector>

#include "pipeline/match/image/box_filter.h"

namespace relievo::pipeline {
namespace {

constexpr float kSteep = 0.7F;     // disparity a pixel: skin so foreshortened says little
constexpr int kGap = 3;            // nodes less steep that do not end a curtain
constexpr int kBeside = 2;         // nodes beside a curtain that it still bends
constexpr int kSlope = 5;          // nodes over which the slope of the surface beside it is taken
constexpr int kMargin = 2;         // nodes beyond those beside it in which the cut is looked for
constexpr int kWindow = 3;         // radius over which disagreement is added up
constexpr int kReach = 4;          // full-size pixels by which a continued surface may be off
constexpr int kStride = 2;
constexpr int kOffsetWindow = 10;  // radius over which one view is brighter than the other by a constant
constexpr float kLoud = 20;        // grey levels: what disagrees by more is as wrong as can be

// Nodes [from, to] of a row for which both surfaces were continued.
struct Curtain {
  int y, from, to;
};

struct Surfaces {
  Surfaces(std::pmr::memory_resource* memory, int w, int h)
      : near(memory, w, h), far(memory, w, h), asked(memory, w, h) {}
  Plane<float> near, far;  // continued disparity, full-size pixels
  Plane<float> asked;      // 1 where a curtain hangs
};

// What the views disagree by, on average over a window: at best near the continued surfaces, and as the field is now.
struct Disagreement {
  Disagreement(std::pmr::memory_resource* memory, int w, int h) : near(memory, w, h, kLoud), far(memory, w, h, kLoud), now(memory, w, h, kLoud) {}
  Plane<float> near, far, now;
};

// The next row of steep nodes from x on, [from, to]; none: from > to.
struct Steep {
  int from = 1, to = 0;
};

Steep next_steep(const float* d, const std::uint8_t* in, int x, int w, float step) {
  const auto falls = [&](int i) { return (in[i] & in[i - 1]) != 0 && d[i - 1] - d[i] > kSteep * step; };
  while (x < w && !falls(x)) ++x;
  if (x >= w) return {};
  Steep steep{x - 1, x};
  for (int i = x + 1; i < w && i <= steep.to + kGap + 1; ++i)
    if (falls(i)) steep.to = i;
  return steep;
}

// Continues what lies on both sides of steep nodes; not where the field ends beside them.
std::optional<Curtain> hang(const SurfaceField& field, int y, const Steep& steep, Surfaces& surfaces) {
  const float* d = field.disparity_px.row(y);
  const std::uint8_t* in = field.domain.row(y);
  const int left = steep.from - kBeside;
  const int right = steep.to + kBeside;
  if (left - kSlope < 0 || right + kSlope >= field.domain.width) return std::nullopt;
  if (!std::all_of(in + left - kSlope, in + right + kSlope + 1, [](std::uint8_t inside) { return inside != 0; })) return std::nullopt;
  const float limit = kSteep * static_cast<float>(field.step_px);
  const float near_slope = std::clamp((d[left] - d[left - kSlope]) / kSlope, -limit, limit);
  const float far_slope = std::clamp((d[right + kSlope] - d[right]) / kSlope, -limit, limit);
  const Curtain curtain{y, left - kMargin, right + kMargin};
  for (int x = curtain.from; x <= curtain.to; ++x) {
    surfaces.near.row(y)[x] = d[left] + near_slope * static_cast<float>(x - left);
    surfaces.far.row(y)[x] = d[right] + far_slope * static_cast<float>(x - right);
    surfaces.asked.row(y)[x] = 1;
  }
  return curtain;
}

std::pmr::vector<Curtain> find_curtains(const SurfaceField& field, Surfaces& surfaces, std::pmr::memory_resource* memory) {
  std::pmr::vector<Curtain> curtains(memory);
  const int w = field.domain.width;
  const auto step = static_cast<float>(field.step_px);
  for (int y = 0; y < field.domain.height; ++y)
    for (int x = 1; x < w;) {
      const Steep steep = next_steep(field.disparity_px.row(y), field.domain.row(y), x, w, step);
      if (steep.from > steep.to) break;
      x = steep.to + 1;
      if (const auto curtain = hang(field, y, steep, surfaces)) curtains.push_back(*curtain);
    }
  return curtains;
}

// The right view where it shows node x at disparity d, between two pixels; none beyond its edge.
std::optional<float> seen_at(const RefinerScene& scene, int x, int y, float d) {
  const float at = static_cast<float>(x) - d / static_cast<float>(1 << scene.level);
  if (!(at >= 0 && at < static_cast<float>(scene.right.width - 1))) return std::nullopt;
  const int k = static_cast<int>(at);
  const std::uint8_t* valid = scene.right_valid.row(y);
  if ((valid[k] & valid[k + 1]) == 0) return std::nullopt;
  const float* right = scene.right.row(y);
  return right[k] + (at - static_cast<float>(k)) * (right[k + 1] - right[k]);
}

// By how much the left view is brighter around each node, off the curtains.
void measure_offset(const RefinerScene& scene, const SurfaceField& field, const Surfaces& surfaces, StageContext& context,
                    Plane<float>& offset) {
  const int w = offset.width;
  Plane<float> across(&context.scratch, w, offset.height), count(&context.scratch, w, offset.height);
  for (int y = 0; y < offset.height; ++y)
    for (int x = 0; x < w; ++x) {
      if (field.domain.row(y)[x] == 0 || surfaces.asked.row(y)[x] != 0) continue;
      const auto seen = seen_at(scene, x, y, field.disparity_px.row(y)[x]);
      if (!seen) continue;
      offset.row(y)[x] = std::clamp(scene.left.row(y)[x] - *seen, -kLoud, kLoud);
      count.row(y)[x] = 1;
    }
  box_sum(offset, kOffsetWindow, context.pool, across, offset);
  box_sum(count, kOffsetWindow, context.pool, across, count);
  for (std::size_t k = 0; k < offset.values.size(); ++k) offset.values[k] /= std::max(count.values[k], 1.0F);
}

struct Views {
  const RefinerScene& scene;
  const std::pmr::vector<Curtain>& curtains;
  const Plane<float>& offset;
  const Plane<float>& asked;  // how many nodes of a curtain a window holds
};

// The mean disagreement over a window of the curtain, the surface being d + shift.
void disagree(const Views& views, const Plane<float>& d, float shift, ThreadPool& pool, Plane<float>& across, Plane<float>& mean) {
  std::fill(mean.values.begin(), mean.values.end(), 0.0F);
  for (const auto& [y, from, to] : views.curtains)
    for (int x = from; x <= to; ++x) {
      const auto seen = seen_at(views.scene, x, y, d.row(y)[x] + shift);
      mean.row(y)[x] = seen ? std::min(kLoud, std::abs(views.scene.left.row(y)[x] - *seen - views.offset.row(y)[x])) : kLoud;
    }
  box_sum(mean, kWindow, pool, across, mean);
  for (std::size_t k = 0; k < mean.values.size(); ++k) mean.values[k] /= std::max(views.asked.values[k], 1.0F);
}

// The least for a surface continued as `d`, which may well have bent on its way under the curtain.
void disagree_least(const Views& views, const Plane<float>& d, StageContext& context, Plane<float>& least) {
  Plane<float> across(&context.scratch, d.width, d.height), mean(&context.scratch, d.width, d.height);
  for (int shift = -kReach; shift <= kReach; shift += kStride) {
    disagree(views, d, static_cast<float>(shift), context.pool, across, mean);
    for (std::size_t k = 0; k < mean.values.size(); ++k) least.values[k] = std::min(least.values[k], mean.values[k]);
  }
}

void measure_disagreement(const RefinerScene& scene, const SurfaceField& field, const std::pmr::vector<Curtain>& curtains,
                          const Surfaces& surfaces, StageContext& context, Disagreement& sums) {
  const int w = field.domain.width;
  const int h = field.domain.height;
  Plane<float> offset(&context.scratch, w, h), across(&context.scratch, w, h), asked(&context.scratch, w, h);
  measure_offset(scene, field, surfaces, context, offset);
  box_sum(surfaces.asked, kWindow, context.pool, across, asked);
  const Views views{scene, curtains, offset, asked};
  disagree_least(views, surfaces.near, context, sums.near);
  disagree_least(views, surfaces.far, context, sums.far);
  disagree(views, field.disparity_px, 0, context.pool, across, sums.now);
}

// The first node of the far surface; none where the curtain explains the views better.
std::optional<int> best_cut(const Curtain& curtain, const Disagreement& sums) {
  const float *near = sums.near.row(curtain.y), *far = sums.far.row(curtain.y), *now = sums.now.row(curtain.y);
  float sum = 0;
  float hanging = 0;
  for (int x = curtain.from; x <= curtain.to; ++x) {
    sum += far[x];
    hanging += now[x];
  }
  float best = sum;
  int cut = curtain.from;
  for (int x = curtain.from; x <= curtain.to; ++x) {
    sum += near[x] - far[x];
    if (sum >= best) continue;
    best = sum;
    cut = x + 1;
  }
  if (best > hanging) return std::nullopt;
  return cut;
}

}  // namespace

int cut_at_occluding_contours(const RefinerScene& scene, StageContext& context, SurfaceField& field) {
  const int w = field.domain.width;
  const int h = field.domain.height;
  Arena::Mark mark(context.scratch);
  Surfaces surfaces(&context.scratch, w, h);
  const auto curtains = find_curtains(field, surfaces, &context.scratch);
  if (curtains.empty()) return 0;
  Disagreement sums(&context.scratch, w, h);
  measure_disagreement(scene, field, curtains, surfaces, context, sums);
  int rows = 0;
  for (const Curtain& curtain : curtains) {
    const auto cut = best_cut(curtain, sums);
    if (!cut) continue;
    float* d = field.disparity_px.row(curtain.y);
    std::copy(surfaces.near.row(curtain.y) + curtain.from, surfaces.near.row(curtain.y) + *cut, d + curtain.from);
    std::copy(surfaces.far.row(curtain.y) + *cut, surfaces.far.row(curtain.y) + curtain.to + 1, d + *cut);
    ++rows;
  }
  return rows;
}

}  // namespace relievo::pipeline

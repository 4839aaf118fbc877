// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/refine/surface_refiner.h"

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <optional>
#include <vector>

namespace relievo::pipeline {
namespace {

constexpr float kSteep = 0.7F;      // disparity a pixel: skin so foreshortened says little
constexpr int kGap = 3;             // nodes less steep that do not end a curtain
constexpr int kBeside = 2;          // nodes beside a curtain that it still bends
constexpr int kSlope = 5;           // nodes over which the slope of the surface beside it is taken
constexpr int kCutMargin = 2;       // nodes beyond those beside it in which the cut is looked for
constexpr int kWindow = 3;          // radius over which disagreement is added up
constexpr int kContinuedReach = 4;  // full-size pixels by which a continued surface may be off
constexpr int kStride = 2;
constexpr int kOffsetWindow = 10;   // radius over which one view is brighter than the other by a constant
constexpr float kLoudContour = 20;  // grey levels: what disagrees by more is as wrong as can be

// A row or a column of nodes: node i of it is values[first + i * stride].
struct Line {
  int first = 0, stride = 1, count = 0;
  std::size_t at(int i) const { return std::size_t(first + i * stride); }
};

// Nodes [from, to] of a line for which both surfaces were continued.
struct Curtain {
  Line line;
  int from, to;
};

struct Surfaces {
  PlaneShape shape;
  Plane<float> before{shape}, behind{shape};  // continued disparity, full-size pixels
  Plane<float> asked{shape};                  // 1 where a curtain hangs
};

// What the views disagree by, mean over a window: at best near the continued surfaces, and as the field is.
struct Disagreement {
  PlaneShape shape;
  Plane<float> before{shape, kLoudContour}, behind{shape, kLoudContour}, now{shape, kLoudContour};
};

// How steep the field is along the row, a pixel.
float steepness_across(const SurfaceField& field, std::size_t k) {
  const auto x = int(k) % field.domain.width;
  float most = 0;
  for (const int side : {-1, 1}) {
    if (x + side < 0 || x + side >= field.domain.width) continue;
    const auto beside = std::size_t(std::ptrdiff_t(k) + side);
    if (field.domain.values[beside] != 0)
      most = std::max(most, std::abs(field.disparity_px.values[beside] - field.disparity_px.values[k]));
  }
  return most;
}

// The next run of steep nodes from i on, [from, to]; none: from > to. Along a row they fall; along a column
// either way, and more steeply than along the row: what stands upright is the rows' own.
struct Steep {
  int from = 1, to = 0;
};

Steep next_steep(const SurfaceField& field, const Line& line, int i) {
  const float limit = kSteep * float(field.step_px);
  const auto is_steep = [&](int k) {
    const std::size_t here = line.at(k), before = line.at(k - 1);
    if ((field.domain.values[here] & field.domain.values[before]) == 0) return false;
    const float fall = field.disparity_px.values[before] - field.disparity_px.values[here];
    return line.stride == 1 ? fall > limit : std::abs(fall) > std::max(limit, steepness_across(field, here));
  };
  while (i < line.count && !is_steep(i)) ++i;
  if (i >= line.count) return {};
  Steep steep{i - 1, i};
  for (int k = i + 1; k < line.count && k <= steep.to + kGap + 1; ++k)
    if (is_steep(k)) steep.to = k;
  return steep;
}

// Continues what lies on both sides of steep nodes; not where the field ends beside them.
std::optional<Curtain> hang(const SurfaceField& field, const Line& line, const Steep& steep,
                            Surfaces& surfaces) {
  const auto d = [&](int i) { return field.disparity_px.values[line.at(i)]; };
  const int before = steep.from - kBeside;
  const int behind = steep.to + kBeside;
  if (before - kSlope < 0 || behind + kSlope >= line.count) return std::nullopt;
  for (int i = before - kSlope; i <= behind + kSlope; ++i)
    if (field.domain.values[line.at(i)] == 0) return std::nullopt;
  const float limit = kSteep * float(field.step_px);
  const float slope_before = std::clamp((d(before) - d(before - kSlope)) / kSlope, -limit, limit);
  const float slope_behind = std::clamp((d(behind + kSlope) - d(behind)) / kSlope, -limit, limit);
  const Curtain curtain{line, before - kCutMargin, behind + kCutMargin};
  for (int i = curtain.from; i <= curtain.to; ++i) {
    surfaces.before.values[line.at(i)] = d(before) + slope_before * float(i - before);
    surfaces.behind.values[line.at(i)] = d(behind) + slope_behind * float(i - behind);
    surfaces.asked.values[line.at(i)] = 1;
  }
  return curtain;
}

std::pmr::vector<Curtain> find_curtains(const SurfaceField& field, bool rows, Surfaces& surfaces,
                                        std::pmr::memory_resource* memory) {
  std::pmr::vector<Curtain> curtains(memory);
  const int w = field.domain.width, h = field.domain.height;
  for (int k = 0; k < (rows ? h : w); ++k) {
    const Line line = rows ? Line{k * w, 1, w} : Line{k, w, h};
    for (int i = 1; i < line.count;) {
      const Steep steep = next_steep(field, line, i);
      if (steep.from > steep.to) break;
      i = steep.to + 1;
      if (const auto curtain = hang(field, line, steep, surfaces)) curtains.push_back(*curtain);
    }
  }
  return curtains;
}

// The right view where it shows node x at disparity d, between two pixels; none beyond its edge.
std::optional<float> seen_at(const RefinerScene& scene, int x, int y, float d) {
  const float at = float(x) - d / float(1 << scene.level);
  if (!(at >= 0 && at < float(scene.right.width - 1))) return std::nullopt;
  const int k = int(at);
  const std::uint8_t* valid = scene.right_valid.row(y);
  if ((valid[k] & valid[k + 1]) == 0) return std::nullopt;
  const float* right = scene.right.row(y);
  return right[k] + (at - float(k)) * (right[k + 1] - right[k]);
}

// By how much the left view is brighter around each node, off the curtains.
void measure_offset(const RefinerScene& scene, const SurfaceField& field, const Surfaces& surfaces,
                    StageContext& context, Plane<float>& offset) {
  const int w = offset.width;
  Plane<float> across(&context.scratch, w, offset.height), count(&context.scratch, w, offset.height);
  for (int y = 0; y < offset.height; ++y)
    for (int x = 0; x < w; ++x) {
      if (field.domain.row(y)[x] == 0 || surfaces.asked.row(y)[x] != 0) continue;
      const auto seen = seen_at(scene, x, y, field.disparity_px.row(y)[x]);
      if (!seen) continue;
      offset.row(y)[x] = std::clamp(scene.left.row(y)[x] - *seen, -kLoudContour, kLoudContour);
      count.row(y)[x] = 1;
    }
  box_sum(offset, kOffsetWindow, context.pool, across, offset);
  box_sum(count, kOffsetWindow, context.pool, across, count);
  for (std::size_t k = 0; k < offset.values.size(); ++k) offset.values[k] /= std::max(count.values[k], 1.0F);
}

struct ContourViews {
  const RefinerScene& scene;
  const std::pmr::vector<Curtain>& curtains;
  const Plane<float>& offset;
  const Plane<float>& asked;  // how many nodes of a curtain a window holds
};

// The mean disagreement over a window of the curtain, the surface being d + shift.
void disagree(const ContourViews& views, const Plane<float>& d, float shift, ThreadPool& pool,
              Plane<float>& across, Plane<float>& mean) {
  std::ranges::fill(mean.values, 0.0F);
  for (const auto& [line, from, to] : views.curtains)
    for (int i = from; i <= to; ++i) {
      const std::size_t k = line.at(i);
      const int x = int(k) % d.width, y = int(k) / d.width;
      const auto seen = seen_at(views.scene, x, y, d.values[k] + shift);
      mean.values[k] =
          seen ? std::min(kLoudContour, std::abs(views.scene.left.row(y)[x] - *seen - views.offset.values[k]))
               : kLoudContour;
    }
  box_sum(mean, kWindow, pool, across, mean);
  for (std::size_t k = 0; k < mean.values.size(); ++k)
    mean.values[k] /= std::max(views.asked.values[k], 1.0F);
}

// The least for a surface continued as `d`, which may well have bent on its way under the curtain.
void disagree_least(const ContourViews& views, const Plane<float>& d, StageContext& context,
                    Plane<float>& least) {
  Plane<float> across(&context.scratch, d.width, d.height), mean(&context.scratch, d.width, d.height);
  for (int shift = -kContinuedReach; shift <= kContinuedReach; shift += kStride) {
    disagree(views, d, float(shift), context.pool, across, mean);
    for (std::size_t k = 0; k < mean.values.size(); ++k)
      least.values[k] = std::min(least.values[k], mean.values[k]);
  }
}

// The first node of the surface behind the cut; none where the curtain explains the views better.
std::optional<int> best_cut(const Curtain& curtain, const Disagreement& sums) {
  float sum = 0;
  float hanging = 0;
  for (int i = curtain.from; i <= curtain.to; ++i) {
    sum += sums.behind.values[curtain.line.at(i)];
    hanging += sums.now.values[curtain.line.at(i)];
  }
  float best = sum;
  int cut = curtain.from;
  for (int i = curtain.from; i <= curtain.to; ++i) {
    sum += sums.before.values[curtain.line.at(i)] - sums.behind.values[curtain.line.at(i)];
    if (sum >= best) continue;
    best = sum;
    cut = i + 1;
  }
  if (best > hanging) return std::nullopt;
  return cut;
}

int cut_along(bool rows, const RefinerScene& scene, StageContext& context, SurfaceField& field) {
  Arena::Mark mark(context.scratch);
  const PlaneShape shape{&context.scratch, field.domain.width, field.domain.height};
  Surfaces surfaces{shape};
  const auto curtains = find_curtains(field, rows, surfaces, &context.scratch);
  if (curtains.empty()) return 0;
  Disagreement sums{shape};
  Plane<float> offset(shape), across(shape), asked(shape);
  measure_offset(scene, field, surfaces, context, offset);
  box_sum(surfaces.asked, kWindow, context.pool, across, asked);
  const ContourViews views{scene, curtains, offset, asked};
  disagree_least(views, surfaces.before, context, sums.before);
  disagree_least(views, surfaces.behind, context, sums.behind);
  disagree(views, field.disparity_px, 0, context.pool, across, sums.now);
  int lines = 0;
  for (const Curtain& curtain : curtains) {
    const auto cut = best_cut(curtain, sums);
    if (!cut) continue;
    for (int i = curtain.from; i <= curtain.to; ++i) {
      const std::size_t k = curtain.line.at(i);
      field.disparity_px.values[k] = (i < *cut ? surfaces.before : surfaces.behind).values[k];
    }
    ++lines;
  }
  return lines;
}

}  // namespace

int cut_at_occluding_contours(const RefinerScene& scene, StageContext& context, SurfaceField& field) {
  const int columns = cut_along(false, scene, context, field);
  return columns + cut_along(true, scene, context, field);
}

}  // namespace relievo::pipeline

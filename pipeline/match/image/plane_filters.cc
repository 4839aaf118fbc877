// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/image/plane_filters.h"

#include <algorithm>
#include <cmath>

#include "hal/base/simd.h"

namespace relievo::pipeline {
namespace {

constexpr int kBands = 16, kBoxBands = 8;
constexpr int kTogether = 4;  // rows: a running sum waits for itself, four of them do not wait for each other

// Rows y to y + rows, at most kTogether of them.
void sum_rows(const Plane<float>& from, int y, int rows, int radius, Plane<float>& to) {
  const int w = from.width;
  const float* in[kTogether];
  float* out[kTogether];
  for (int k = 0; k < kTogether; ++k) {
    in[k] = from.row(y + std::min(k, rows - 1));
    out[k] = to.row(y + std::min(k, rows - 1));
  }
  // Double, because a running sum in single precision drifts along a row of large squares.
  double sum[kTogether] = {};
  const auto slide = [&](int begin, int end, bool enters, bool leaves) {
    for (int x = begin; x < end; ++x)
      for (int k = 0; k < kTogether; ++k) {
        if (enters) sum[k] += in[k][x + radius];
        if (leaves) sum[k] -= in[k][x - radius - 1];
        out[k][x] = float(sum[k]);
      }
  };
  for (int x = 0; x < std::min(radius, w); ++x)
    for (int k = 0; k < kTogether; ++k) sum[k] += in[k][x];
  const int full = std::min(radius + 1, w);  // from here a pixel leaves the window
  const int last = std::max(w - radius, 0);  // from here none enters
  slide(0, std::min(full, last), true, false);
  slide(std::min(full, last), full, false, false);
  slide(full, std::max(full, last), true, true);
  slide(std::max(full, last), w, false, true);
}

RELIEVO_SIMD void add_row(const float* from, int count, float* to) {
  for (int x = 0; x < count; ++x) to[x] += from[x];
}
RELIEVO_SIMD void slide_row(const float* above, const float* in, const float* out, int count, float* to) {
  for (int x = 0; x < count; ++x) to[x] = above[x] + (in[x] - out[x]);
}

// to += weight * (a + b)
RELIEVO_SIMD void add_weighted(const float* a, const float* b, float weight, int count, float* to) {
  for (int x = 0; x < count; ++x) to[x] += weight * (a[x] + b[x]);
}

// to = min(to, from)
RELIEVO_SIMD void lower(const float* from, int count, float* to) {
  for (int x = 0; x < count; ++x) to[x] = from[x] < to[x] ? from[x] : to[x];
}

// to = max(to, from)
RELIEVO_SIMD void raise(const float* from, int count, float* to) {
  for (int x = 0; x < count; ++x) to[x] = from[x] > to[x] ? from[x] : to[x];
}

template <typename Towards>
void over_square(Plane<float>& plane, int reach, Towards towards, ThreadPool& pool, Plane<float>& room) {
  const int width = plane.width, height = plane.height;
  pool.for_each(height, kBands, [&](int y) {
    float* to = room.row(y);
    std::copy_n(plane.row(y), width, to);
    for (int v = std::max(y - reach, 0); v <= std::min(y + reach, height - 1); ++v)
      towards(plane.row(v), width, to);
  });
  pool.for_each(height, kBands, [&](int y) {
    const float* from = room.row(y);
    float* to = plane.row(y);
    std::copy_n(from, width, to);
    for (int i = 1; i <= std::min(reach, width - 1); ++i) {
      towards(from + i, width - i, to);
      towards(from, width - i, to + i);
    }
  });
}

float across(const float* row, int x, int width) {
  const auto at = [&](int k) { return row[std::clamp(k, 0, width - 1)]; };
  return at(x - 2) + 4 * at(x - 1) + 6 * at(x) + 4 * at(x + 1) + at(x + 2);
}

}  // namespace

void box_sum(const Plane<float>& from, int radius, ThreadPool& pool, Plane<float>& across, Plane<float>& to) {
  const int w = from.width;
  const int h = from.height;
  pool.for_each_band(h, kBoxBands, [&](int begin, int end, int) {
    for (int y = begin; y < end; y += kTogether)
      sum_rows(from, y, std::min(kTogether, end - y), radius, across);
  });
  // Bands of rows, each started afresh: rounding does not travel down the whole picture.
  pool.for_each_band(h, kBoxBands, [&](int begin, int end, int) {
    float* top = to.row(begin);
    std::fill(top, top + w, 0.0F);
    for (int y = std::max(0, begin - radius); y <= std::min(h - 1, begin + radius); ++y)
      add_row(across.row(y), w, top);
    for (int y = begin + 1; y < end; ++y) {
      const float* in = y + radius < h ? across.row(y + radius) : nullptr;
      const float* out = y - radius - 1 >= 0 ? across.row(y - radius - 1) : nullptr;
      float* here = to.row(y);
      const float* above = to.row(y - 1);
      if (in != nullptr && out != nullptr) slide_row(above, in, out, w, here);
      else {
        for (int x = 0; x < w; ++x)
          here[x] = above[x] + (in != nullptr ? in[x] : 0.0F) - (out != nullptr ? out[x] : 0.0F);
      }
    }
  });
}

Gaussian::Gaussian(double sigma_cells) {
  reach_ = std::min(int(std::ceil(3 * sigma_cells)), int(weight_.size()) - 1);
  float sum = 0;
  for (int i = 0; i <= reach_; ++i) {
    float& weight = weight_[std::size_t(i)];
    weight = float((i == 0 ? 0.5 : 1.0) * std::exp(-0.5 * i * i / (sigma_cells * sigma_cells)));
    sum += 2 * weight;
  }
  for (float& weight : weight_) weight /= sum;
}

void Gaussian::smooth(Plane<float>& plane, ThreadPool& pool, Plane<float>& room) const {
  const int reach = reach_;
  pool.for_each(plane.height, kBands, [&](int y) {
    float* wide = room.row(y);
    float* to = wide + reach;
    std::fill_n(to, plane.width, 0.0F);
    for (int i = 0; i <= reach; ++i)
      add_weighted(plane.row(std::max(y - i, 0)), plane.row(std::min(y + i, plane.height - 1)),
                   weight_[std::size_t(i)], plane.width, to);
    std::fill_n(wide, reach, to[0]);
    std::fill_n(to + plane.width, reach, to[plane.width - 1]);
  });
  pool.for_each(plane.height, kBands, [&](int y) {
    const float* from = room.row(y) + reach;
    float* to = plane.row(y);
    std::fill_n(to, plane.width, 0.0F);
    for (int i = 0; i <= reach; ++i)
      add_weighted(from - i, from + i, weight_[std::size_t(i)], plane.width, to);
  });
}

void erode(Plane<float>& plane, int reach, ThreadPool& pool, Plane<float>& room) {
  over_square(plane, reach, lower, pool, room);
}

void dilate(Plane<float>& plane, int reach, ThreadPool& pool, Plane<float>& room) {
  over_square(plane, reach, raise, pool, room);
}

Pyramids build_pyramids(const RectifiedPair& pair, int count, StageContext& context) {
  const auto build = [&](const RectifiedView& view) {
    std::pmr::vector<PyramidLevel> levels(&context.scratch);
    levels.reserve(std::size_t(count));
    levels.emplace_back(&context.scratch, pair.width_px, pair.height_px);
    std::ranges::copy(view.grey, levels[0].grey.values.begin());
    std::ranges::copy(view.valid, levels[0].valid.values.begin());
    for (int level = 1; level < count; ++level)
      levels.emplace_back(&context.scratch, (levels.back().grey.width + 1) / 2,
                          (levels.back().grey.height + 1) / 2);
    halve_levels(levels, context.pool);
    return levels;
  };
  return {build(pair.left), build(pair.right)};
}

void halve_row(const PyramidLevel& whole, PyramidLevel& half, int j) {
  const int width = whole.grey.width, height = whole.grey.height;
  constexpr float kWeight[5] = {1, 4, 6, 4, 1};
  float* to = half.grey.row(j);
  std::fill(to, to + half.grey.width, 0.0F);
  for (int k = -2; k <= 2; ++k) {
    const float* from = whole.grey.row(std::clamp(2 * j + k, 0, height - 1));
    const float w = kWeight[k + 2] * (1.0F / 256);
    const int inner_end = std::min(half.grey.width, (width - 2) / 2);
    for (int i = 0; i < std::min(1, half.grey.width); ++i) to[i] += w * across(from, 2 * i, width);
    for (int i = 1; i < inner_end; ++i) {
      const float* p = from + 2 * i;
      to[i] += w * (p[-2] + 4 * p[-1] + 6 * p[0] + 4 * p[1] + p[2]);
    }
    for (int i = std::max(1, inner_end); i < half.grey.width; ++i) to[i] += w * across(from, 2 * i, width);
  }
  const std::uint8_t* from = whole.valid.row(std::min(2 * j, height - 1));
  std::uint8_t* flag = half.valid.row(j);
  for (int i = 0; i < half.grey.width; ++i) flag[i] = from[std::min(2 * i, width - 1)];
}

void halve_levels(std::pmr::vector<PyramidLevel>& levels, ThreadPool& pool) {
  constexpr int kPyramidBands = 8;
  for (std::size_t level = 1; level < levels.size(); ++level) {
    PyramidLevel& to = levels[level];
    pool.for_each(to.grey.height, kPyramidBands, [&](int j) { halve_row(levels[level - 1], to, j); });
  }
}

}  // namespace relievo::pipeline

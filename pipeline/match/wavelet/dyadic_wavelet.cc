// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/wavelet/dyadic_wavelet.h"

#include <algorithm>
#include <utility>

namespace relievo::pipeline {
namespace {

constexpr int kBands = 16;

void differ(const Plane<float>& from, int hole, ThreadPool& pool, Plane<Vec2f>& to) {
  const int w = from.width;
  const int h = from.height;
  pool.for_each_band(h, kBands, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y) {
      const float* row = from.row(y);
      const float* above = from.row(std::max(0, y - hole));
      const float* below = from.row(std::min(h - 1, y + hole));
      Vec2f* out = to.row(y);
      for (int x = 0; x < w; ++x)
        out[x] = {0.5F * (row[std::min(w - 1, x + hole)] - row[std::max(0, x - hole)]),
                  0.5F * (below[x] - above[x])};
    }
  });
}

void smooth(const Plane<float>& from, int hole, ThreadPool& pool, Plane<float>& across, Plane<float>& to) {
  const int w = from.width;
  const int h = from.height;
  constexpr float kWeight[5] = {1.0F / 16, 4.0F / 16, 6.0F / 16, 4.0F / 16, 1.0F / 16};
  pool.for_each_band(h, kBands, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y) {
      const float* row = from.row(y);
      float* out = across.row(y);
      for (int x = 0; x < w; ++x) {
        float sum = 0;
        for (int k = -2; k <= 2; ++k) sum += kWeight[k + 2] * row[std::clamp(x + k * hole, 0, w - 1)];
        out[x] = sum;
      }
    }
  });
  pool.for_each_band(h, kBands, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y) {
      float* out = to.row(y);
      std::fill(out, out + w, 0.0F);
      for (int k = -2; k <= 2; ++k) {
        const float* row = across.row(std::clamp(y + k * hole, 0, h - 1));
        for (int x = 0; x < w; ++x) out[x] += kWeight[k + 2] * row[x];
      }
    }
  });
}

}  // namespace

std::pmr::vector<Plane<Vec2f>> transform_dyadic(const std::pmr::vector<float>& grey, int width, int height,
                                                int scales, StageContext& context) {
  std::pmr::vector<Plane<Vec2f>> all(&context.scratch);
  all.reserve(static_cast<std::size_t>(scales));
  for (int j = 0; j < scales; ++j) all.emplace_back(&context.scratch, width, height);
  Arena::Mark mark(context.scratch);
  Plane<float> now(&context.scratch, width, height);
  std::copy(grey.begin(), grey.end(), now.values.begin());
  Plane<float> across(&context.scratch, width, height);
  Plane<float> next(&context.scratch, width, height);
  for (int j = 0; j < scales && !context.stop(); ++j) {
    const int hole = 1 << j;
    differ(now, hole, context.pool, all[static_cast<std::size_t>(j)]);
    if (j + 1 == scales) break;
    smooth(now, hole, context.pool, across, next);
    std::swap(now.values, next.values);
  }
  return all;
}

}  // namespace relievo::pipeline

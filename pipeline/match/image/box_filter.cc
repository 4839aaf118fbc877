// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/image/box_filter.h"

#include <algorithm>

#include "hal/base/simd.h"

namespace relievo::pipeline {
namespace {

constexpr int kBands = 8;

void sum_row(const float* from, int radius, int w, float* to) {
  // Double, because a running sum in single precision drifts along a row of large squares.
  double sum = 0;
  for (int x = 0; x < std::min(radius, w); ++x) sum += from[x];
  for (int x = 0; x < w; ++x) {
    if (x + radius < w) sum += from[x + radius];
    if (x - radius - 1 >= 0) sum -= from[x - radius - 1];
    to[x] = static_cast<float>(sum);
  }
}

RELIEVO_SIMD void add_row(const float* from, int begin, int end, float* to) {
  for (int x = begin; x < end; ++x) to[x] += from[x];
}
RELIEVO_SIMD void slide_row(const float* above, const float* in, const float* out, int begin, int end, float* to) {
  for (int x = begin; x < end; ++x) to[x] = above[x] + (in[x] - out[x]);
}

}  // namespace

void box_sum(const Plane<float>& from, int radius, ThreadPool& pool, Plane<float>& across, Plane<float>& to) {
  const int w = from.width;
  const int h = from.height;
  pool.for_each_band(h, kBands, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y) sum_row(from.row(y), radius, w, across.row(y));
  });
  // Bands of rows, each started afresh: rounding does not travel down the whole picture.
  pool.for_each_band(h, kBands, [&](int begin, int end, int) {
    float* top = to.row(begin);
    std::fill(top, top + w, 0.0F);
    for (int y = std::max(0, begin - radius); y <= std::min(h - 1, begin + radius); ++y) add_row(across.row(y), 0, w, top);
    for (int y = begin + 1; y < end; ++y) {
      const float* in = y + radius < h ? across.row(y + radius) : nullptr;
      const float* out = y - radius - 1 >= 0 ? across.row(y - radius - 1) : nullptr;
      float* here = to.row(y);
      const float* above = to.row(y - 1);
      if (in != nullptr && out != nullptr) slide_row(above, in, out, 0, w, here);
      else {
        for (int x = 0; x < w; ++x) here[x] = above[x] + (in != nullptr ? in[x] : 0.0F) - (out != nullptr ? out[x] : 0.0F);
      }
    }
  });
}

}  // namespace relievo::pipeline

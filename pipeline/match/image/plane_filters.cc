// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/image/plane_filters.h"

#include <algorithm>
#include <cmath>

#include "hal/base/simd.h"

namespace relievo::pipeline {
namespace {

constexpr int kRowsOfABand = 16;

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
  pool.for_each_band(height, kRowsOfABand, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y) {
      float* to = room.row(y);
      std::copy_n(plane.row(y), width, to);
      for (int v = std::max(y - reach, 0); v <= std::min(y + reach, height - 1); ++v)
        towards(plane.row(v), width, to);
    }
  });
  pool.for_each_band(height, kRowsOfABand, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y) {
      const float* from = room.row(y);
      float* to = plane.row(y);
      std::copy_n(from, width, to);
      for (int i = 1; i <= std::min(reach, width - 1); ++i) {
        towards(from + i, width - i, to);
        towards(from, width - i, to + i);
      }
    }
  });
}

}  // namespace

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
  pool.for_each_band(plane.height, kRowsOfABand, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y) {
      float* wide = room.row(y);
      float* to = wide + reach;
      std::fill_n(to, plane.width, 0.0F);
      for (int i = 0; i <= reach; ++i)
        add_weighted(plane.row(std::max(y - i, 0)), plane.row(std::min(y + i, plane.height - 1)),
                     weight_[std::size_t(i)], plane.width, to);
      std::fill_n(wide, reach, to[0]);
      std::fill_n(to + plane.width, reach, to[plane.width - 1]);
    }
  });
  pool.for_each_band(plane.height, kRowsOfABand, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y) {
      const float* from = room.row(y) + reach;
      float* to = plane.row(y);
      std::fill_n(to, plane.width, 0.0F);
      for (int i = 0; i <= reach; ++i)
        add_weighted(from - i, from + i, weight_[std::size_t(i)], plane.width, to);
    }
  });
}

void erode(Plane<float>& plane, int reach, ThreadPool& pool, Plane<float>& room) {
  over_square(
      plane, reach, [](const float* from, int count, float* to) { lower(from, count, to); }, pool, room);
}

void dilate(Plane<float>& plane, int reach, ThreadPool& pool, Plane<float>& room) {
  over_square(
      plane, reach, [](const float* from, int count, float* to) { raise(from, count, to); }, pool, room);
}

}  // namespace relievo::pipeline

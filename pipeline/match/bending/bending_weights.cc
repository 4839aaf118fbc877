// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/bending/bending_weights.h"

#include <algorithm>

#include "pipeline/match/image/box_filter.h"

namespace relievo::pipeline {
namespace {

constexpr int kBands = 16;
constexpr int kPatch = 8;  // radius, nodes
constexpr float kPatchNodes = (2 * kPatch + 1) * (2 * kPatch + 1);

struct Bends {
  float squared = 0;                               // of all second differences
  bool row = false, column = false, cell = false;  // which of them have their neighbours
};

Bends bends_at(const Plane<float>& d, const Plane<std::uint8_t>& domain, int x, int y) {
  const int w = d.width;
  const int h = d.height;
  Bends bends;
  if (domain.row(y)[x] == 0 || x == 0 || y == 0 || x == w - 1 || y == h - 1) return bends;
  const float here = d.row(y)[x];
  const auto in = [&](int i, int j) { return domain.row(y + j)[x + i] != 0; };
  const auto at = [&](int i, int j) { return d.row(y + j)[x + i]; };
  bends.row = in(-1, 0) && in(1, 0);
  bends.column = in(0, -1) && in(0, 1);
  bends.cell = in(1, 0) && in(0, 1) && in(1, 1) && x + 1 < w - 1 && y + 1 < h - 1;
  const float xx = bends.row ? at(-1, 0) - 2 * here + at(1, 0) : 0;
  const float yy = bends.column ? at(0, -1) - 2 * here + at(0, 1) : 0;
  const float xy = bends.cell ? here - at(1, 0) - at(0, 1) + at(1, 1) : 0;
  bends.squared = xx * xx + yy * yy + 2 * xy * xy;
  return bends;
}

void measure_wrinkles(const Plane<float>& d, const Plane<std::uint8_t>& domain, double wrinkle,
                      ThreadPool& pool, Plane<float>& across, Plane<float>& wrinkled) {
  if (!(wrinkle > 0)) return std::fill(wrinkled.values.begin(), wrinkled.values.end(), 0.0F);
  const auto wrinkle2 = static_cast<float>(1 / (wrinkle * wrinkle));
  pool.for_each_band(d.height, kBands, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < d.width; ++x)
        wrinkled.row(y)[x] = std::min(kSharpest, wrinkle2 * bends_at(d, domain, x, y).squared) / kPatchNodes;
  });
  box_sum(wrinkled, kPatch, pool, across, wrinkled);
  for (float& value : wrinkled.values) value = std::clamp(value - kPlain, 0.0F, kMostWrinkled);
}

}  // namespace

void weigh_bending(const Plane<float>& d, const Plane<std::uint8_t>& domain,
                   const BendingExpectation& expected, ThreadPool& pool, Plane<float>& across,
                   Plane<float>& wrinkled, BendingSystem& system) {
  measure_wrinkles(d, domain, expected.wrinkle, pool, across, wrinkled);
  const auto lambda = static_cast<float>(expected.lambda);
  const auto crease2 = static_cast<float>(1 / (expected.crease * expected.crease));
  pool.for_each_band(d.height, kBands, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < d.width; ++x) {
        const Bends bends = bends_at(d, domain, x, y);
        const float omega = lambda / (1 + bends.squared * crease2 + wrinkled.row(y)[x]);
        system.bend_xx.row(y)[x] = bends.row ? omega : 0;
        system.bend_yy.row(y)[x] = bends.column ? omega : 0;
        system.bend_xy.row(y)[x] = bends.cell ? 2 * omega : 0;
      }
  });
}

}  // namespace relievo::pipeline

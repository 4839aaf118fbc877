// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/select/response/corner_response.h"

#include <algorithm>
#include <cmath>

#include "pipeline/match/image/box_filter.h"

namespace relievo::pipeline {
namespace {

constexpr int kBands = 16;

struct Gradient {
  float x, y;
};

Gradient sobel(const float* above, const float* here, const float* below, int x) {
  const float left = above[x - 1] + 2 * here[x - 1] + below[x - 1];
  const float right = above[x + 1] + 2 * here[x + 1] + below[x + 1];
  const float top = above[x - 1] + 2 * above[x] + above[x + 1];
  const float bottom = below[x - 1] + 2 * below[x] + below[x + 1];
  return {0.125F * (right - left), 0.125F * (bottom - top)};
}

// Products of the gradient; 0 along the picture's edge.
template <typename Product>
void products(const std::pmr::vector<float>& grey, Plane<float>& to, ThreadPool& pool, Product product) {
  pool.for_each_band(to.height - 2, kBands, [&](int begin, int end, int) {
    for (int y = begin + 1; y < end + 1; ++y) {
      const float* here = grey.data() + static_cast<std::ptrdiff_t>(y) * to.width;
      float* out = to.row(y);
      for (int x = 1; x + 1 < to.width; ++x)
        out[x] = product(sobel(here - to.width, here, here + to.width, x));
    }
  });
}

}  // namespace

float smaller_eigenvalue(float xx, float xy, float yy, float) {
  const float half = 0.5F * (xx - yy);
  return 0.5F * (xx + yy) - std::sqrt(half * half + xy * xy);
}

float harris_measure(float xx, float xy, float yy, float sensitivity) {
  const float trace = xx + yy;
  return xx * yy - xy * xy - sensitivity * trace * trace;
}

bool corner_response(const std::pmr::vector<float>& grey, const Selectable& selectable,
                     const CornerWindow& window, CornerMeasure measure, float parameter,
                     StageContext& context, Plane<float>& response) {
  std::fill(response.values.begin(), response.values.end(), 0.0F);
  if (response.width < 3 || response.height < 3) return true;
  Arena::Mark mark(context.scratch);
  Plane<float> xx(&context.scratch, response.width, response.height);
  Plane<float> xy(&context.scratch, response.width, response.height);
  Plane<float> yy(&context.scratch, response.width, response.height);
  Plane<float> across(&context.scratch, response.width, response.height);
  products(grey, xx, context.pool, [](Gradient g) { return g.x * g.x; });
  products(grey, xy, context.pool, [](Gradient g) { return g.x * g.y; });
  products(grey, yy, context.pool, [](Gradient g) { return g.y * g.y; });
  for (Plane<float>* plane : {&xx, &xy, &yy})
    for (int pass = 0; pass < window.passes; ++pass) {
      if (context.stop()) return false;
      box_sum(*plane, window.radius_px, context.pool, across, *plane);
    }
  const float side = static_cast<float>(2 * window.radius_px + 1);
  const float mean = 1 / std::pow(side, static_cast<float>(2 * window.passes));
  const int margin = window.reach_px();
  context.pool.for_each_band(response.height, kBands, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < response.width; ++x)
        if (selectable(x, y, margin))
          response.row(y)[x] = std::max(
              0.0F, measure(mean * xx.row(y)[x], mean * xy.row(y)[x], mean * yy.row(y)[x], parameter));
  });
  return !context.stop();
}

}  // namespace relievo::pipeline

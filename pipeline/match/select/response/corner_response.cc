// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/select/response/corner_response.h"

#include <algorithm>
#include <cmath>

#include "pipeline/match/image/box_filter.h"

namespace relievo::pipeline {
namespace {

constexpr int kCornerBands = 16;

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
  pool.for_each_band(to.height - 2, kCornerBands, [&](int begin, int end, int) {
    for (int y = begin + 1; y < end + 1; ++y) {
      const float* here = grey.data() + std::ptrdiff_t(y) * to.width;
      float* out = to.row(y);
      for (int x = 1; x + 1 < to.width; ++x)
        out[x] = product(sobel(here - to.width, here, here + to.width, x));
    }
  });
}

}  // namespace

SalientTracks::SalientTracks(const std::pmr::vector<float>& grey, int width_px, int height_px, int scales,
                             std::pmr::memory_resource* memory)
    : means_(memory) {
  means_.reserve(std::size_t(scales) + 1);
  means_.emplace_back(memory, width_px, height_px);
  std::ranges::copy(grey, means_[0].values.begin());
  for (int s = 0; s < scales && means_.back().width >= 2 && means_.back().height >= 2; ++s) {
    const Plane<float>& from = means_.back();
    Plane<float> to(memory, from.width / 2, from.height / 2);
    for (int y = 0; y < to.height; ++y)
      for (int x = 0; x < to.width; ++x) {
        const float* upper = from.row(2 * y) + 2 * x;
        const float* lower = from.row(2 * y + 1) + 2 * x;
        to.row(y)[x] = 0.25F * (upper[0] + upper[1] + lower[0] + lower[1]);
      }
    means_.push_back(std::move(to));
  }
}

float SalientTracks::magnitude(int scale, int orientation, int column, int row) const {
  const Plane<float>& finer = means_[std::size_t(scale) - 1];
  const float* upper = finer.row(2 * row) + 2 * column;
  const float* lower = finer.row(2 * row + 1) + 2 * column;
  const float left = upper[0] + lower[0], right = upper[1] + lower[1];
  const float difference = orientation == 0   ? right - left
                           : orientation == 1 ? lower[0] + lower[1] - upper[0] - upper[1]
                                              : upper[0] + lower[1] - upper[1] - lower[0];
  return std::ldexp(std::abs(difference),
                    scale - 2);  // means of 4^(scale-1) pixels; 1/2 a level keeps energy
}

Candidate SalientTracks::follow(int scale, int orientation, int column, int row) const {
  float saliency = magnitude(scale, orientation, column, row);
  for (; scale > 1; --scale) {
    float greatest = 0;
    const int first_column = 2 * column;
    const int first_row = 2 * row;
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i)
        if (const float m = magnitude(scale - 1, orientation, first_column + i, first_row + j);
            m > greatest) {
          greatest = m;
          column = first_column + i;
          row = first_row + j;
        }
    if (!(greatest > 0)) break;
    saliency += greatest;
  }
  Candidate end = end_of(scale, column, row);
  end.strength = saliency;
  return end;
}

// Of the pixels under a coefficient the one with the greatest gradient.
Candidate SalientTracks::end_of(int scale, int column, int row) const {
  const Plane<float>& picture = means_[0];
  const int side = 1 << scale;
  Candidate best{side * column, side * row, -1};
  for (int y = side * row; y < side * (row + 1); ++y)
    for (int x = side * column; x < side * (column + 1); ++x) {
      const float dx =
          picture.row(y)[std::min(x + 1, picture.width - 1)] - picture.row(y)[std::max(x - 1, 0)];
      const float dy =
          picture.row(std::min(y + 1, picture.height - 1))[x] - picture.row(std::max(y - 1, 0))[x];
      if (const float gradient = dx * dx + dy * dy; gradient > best.strength) best = {x, y, gradient};
    }
  return best;
}

FastHessian::FastHessian(const std::pmr::vector<float>& grey, int width_px, int height_px,
                         std::pmr::memory_resource* memory)
    : above_(memory, width_px + 1, height_px + 1, 0.0) {
  for (int y = 0; y < height_px; ++y) {
    const float* from = grey.data() + std::ptrdiff_t(y) * width_px;
    double in_row = 0;
    for (int x = 0; x < width_px; ++x) {
      in_row += double(from[x]);
      above_.row(y + 1)[x + 1] = above_.row(y)[x + 1] + in_row;
    }
  }
}

double FastHessian::sum(int left, int top, int width, int height) const {
  const double* upper = above_.row(top) + left;
  const double* lower = above_.row(top + height) + left;
  return lower[width] - lower[0] - upper[width] + upper[0];
}

float FastHessian::determinant(int x, int y, int size) const {
  const int lobe = size / 3;
  const int half = size / 2;
  const int broad = 2 * lobe - 1;
  // Three lobes, 1 -2 1: the whole minus three times the middle.
  const double xx =
      sum(x - half, y - lobe + 1, size, broad) - 3 * sum(x - lobe / 2, y - lobe + 1, lobe, broad);
  const double yy =
      sum(x - lobe + 1, y - half, broad, size) - 3 * sum(x - lobe + 1, y - lobe / 2, broad, lobe);
  const double xy = sum(x + 1, y - lobe, lobe, lobe) + sum(x - lobe, y + 1, lobe, lobe) -
                    sum(x - lobe, y - lobe, lobe, lobe) - sum(x + 1, y + 1, lobe, lobe);
  const double area = double(size) * double(size);
  return float((xx * yy - 0.81 * xy * xy) / (area * area));
}

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
  std::ranges::fill(response.values, 0.0F);
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
  const float side = float(2 * window.radius_px + 1);
  const float mean = 1 / std::pow(side, float(2 * window.passes));
  const int margin = window.reach_px();
  context.pool.for_each_band(response.height, kCornerBands, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < response.width; ++x)
        if (selectable(x, y, margin))
          response.row(y)[x] = std::max(
              0.0F, measure(mean * xx.row(y)[x], mean * xy.row(y)[x], mean * yy.row(y)[x], parameter));
  });
  return !context.stop();
}

}  // namespace relievo::pipeline

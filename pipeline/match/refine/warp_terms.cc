// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/refine/surface_refiner.h"

#include <algorithm>
#include <cmath>

#include "hal/base/simd.h"

namespace relievo::pipeline {
namespace {

constexpr int kBands = 16;
constexpr int kNoiseRadius = 3;
constexpr int kSmallestWindowPx = 9;  // of a smaller level
constexpr float kSaturated = 250;     // grey: a highlight moves with the viewer

struct Sampled {
  float value, slope;
};

// Cubic convolution (Keys 1981, a = -1/2) and its derivative, between row[1] and row[2].
inline Sampled cubic(const float* p, float t) {
  const float a = 0.5F * (p[2] - p[0]);
  const float b = p[0] - 2.5F * p[1] + 2 * p[2] - 0.5F * p[3];
  const float c = 0.5F * (p[3] - p[0]) + 1.5F * (p[1] - p[2]);
  return {p[1] + t * (a + t * (b + t * c)), a + t * (2 * b + t * 3 * c)};
}

// Disparity at a level pixel, in level pixels: bilinear between nodes of the domain.
struct FieldRow {
  const float *upper, *lower;
  const std::uint8_t *upper_in, *lower_in;
  float ty;
};

float node_disparity(const FieldRow& rows, int i, float tx) {
  if (rows.upper_in[i] & rows.upper_in[i + 1] & rows.lower_in[i] & rows.lower_in[i + 1]) {
    const float top = rows.upper[i] + tx * (rows.upper[i + 1] - rows.upper[i]);
    const float low = rows.lower[i] + tx * (rows.lower[i + 1] - rows.lower[i]);
    return top + rows.ty * (low - top);
  }
  return rows.upper[i];  // at the edge of the domain the nearest node to the upper left stands for the cell
}

// The right view as it is seen along the field, and where both views show the surface.
struct Warped {
  Plane<float>& left;  // the left view itself, 0 off the mask
  Plane<float>& right;
  Plane<float>& right_slope;
  Plane<float>& mask;
};

void warp_row(const RefinerScene& scene, const SurfaceField& field, const Window& window, int y,
              Warped& out) {
  const int step = field.step_px >> scene.level;  // 1: nodes are pixels, 2: every other pixel
  const float to_level = 1.0F / float(1 << scene.level);
  const int py = window.y0 + y;
  const int j = py / step;
  const int below = std::min(j + 1, field.domain.height - 1);
  const FieldRow rows{field.disparity_px.row(j), field.disparity_px.row(below), field.domain.row(j),
                      field.domain.row(below), float(py % step) / float(step)};
  const float* left = scene.left.row(py);
  const float* right = scene.right.row(py);
  const std::uint8_t* right_valid = scene.right_valid.row(py);
  for (int x = 0; x < window.width; ++x) {
    const int px = window.x0 + x;
    const int i = px / step;
    out.mask.row(y)[x] = 0;
    out.left.row(y)[x] = out.right.row(y)[x] = out.right_slope.row(y)[x] = 0;
    if (rows.upper_in[i] == 0 || px < 1 || px + 2 > scene.left.width) continue;
    const float tx = float(px % step) / float(step);
    const float d = node_disparity(rows, std::min(i, field.domain.width - 2), tx) * to_level;
    const float at = float(px) - d;
    if (!(at >= 1 && at < float(scene.right.width - 2))) continue;
    const int k = int(at);
    if ((right_valid[k - 1] & right_valid[k + 2]) == 0) continue;
    const Sampled sample = cubic(right + k - 1, at - float(k));
    if (left[px] > kSaturated || sample.value > kSaturated) continue;
    out.mask.row(y)[x] = 1;
    out.left.row(y)[x] = left[px];
    out.right.row(y)[x] = sample.value;
    out.right_slope.row(y)[x] = sample.slope;
  }
}

RELIEVO_SIMD void multiply_row(const float* a, const float* b, int w, float* out) {
  for (int x = 0; x < w; ++x) out[x] = a[x] * b[x];
}

struct Moments {
  const float *count, *left, *right, *left_left, *right_right, *left_right;
};

// May be the rows that are read: `right` becomes the residual, its slope the gradient, moments cost and
// ratio.
struct RowTerms {
  float *residual, *gradient, *cost, *agreed, *ratio;
};

struct RowViews {
  const float *mask, *left, *right, *right_slope;  // left: with a pixel beside it on either side
};

// Offset and gain taken out symmetrically: each view is divided by the root of the local gain. The
// gain is drawn towards the whole face's where there is little texture to tell it from.
RELIEVO_SIMD void residual_row(const Moments& m, const RowViews& s, int begin, int end, float level_scale,
                               float gain, float floor_variance, const RowTerms& out) {
#ifndef __clang__
#pragma GCC ivdep
#endif
  for (int x = begin; x < end; ++x) {
    const float n = 1.0F / std::max(m.count[x], 1.0F);
    const float mean_left = m.left[x] * n;
    const float mean_right = m.right[x] * n;
    const float var_left = std::max(m.left_left[x] * n - mean_left * mean_left, 0.0F);
    const float var_right = std::max(m.right_right[x] * n - mean_right * mean_right, 0.0F);
    const float covariance = m.left_right[x] * n - mean_left * mean_right;
    const float local =
        gain * std::sqrt((var_right / (gain * gain) + floor_variance) / (var_left + floor_variance));
    const float root = std::sqrt(local);
    const float inverse = 1.0F / root;
    const float left_slope = 0.5F * (s.left[x + 1] - s.left[x - 1]);
    out.ratio[x] = mean_right / std::max(mean_left, 1.0F);
    out.residual[x] = s.mask[x] * ((s.right[x] - mean_right) * inverse - (s.left[x] - mean_left) * root);
    const float right_slope = s.right_slope[x];
    out.gradient[x] = s.mask[x] * -0.5F * level_scale * (right_slope * inverse + left_slope * root);
    out.agreed[x] = s.mask[x] * level_scale * level_scale * right_slope * left_slope;  // the roots cancel
    out.cost[x] = 1.0F - s.mask[x] * covariance / std::sqrt(var_left * var_right + 1e-3F);
  }
}

// Of the residuals, robustly: by their median absolute value, from a histogram.
float noise_variance(const WarpTerms& terms) {
  constexpr int kBins = 512;
  constexpr float kPerGrey = 16;
  long histogram[kBins] = {};
  long all = 0;
  for (std::size_t k = 0; k < terms.residual.values.size(); ++k) {
    if (terms.mask.values[k] == 0) continue;
    const int bin = std::min(kBins - 1, int(std::abs(terms.residual.values[k]) * kPerGrey));
    ++histogram[bin];
    ++all;
  }
  long seen = 0;
  int bin = 0;
  while (bin < kBins - 1 && 2 * (seen + histogram[bin]) < all) seen += histogram[bin++];
  const float median = (float(bin) + 0.5F) / kPerGrey;
  const float sigma = 1.4826F * median;
  return std::max(sigma * sigma, 0.05F);
}

// Sums over the window about every pixel. The results' planes hold what leads to them: each plane counts.
struct WindowSums {
  PlaneShape shape;
  WarpTerms& terms;
  Plane<float> count{shape}, left{shape}, right{shape}, left_left{shape};
  Plane<float>& left_right = terms.cost;
  Plane<float>& right_right = terms.weight;
  Plane<float> across{shape};  // for box_sum
};

// The right view goes to the residuals' plane and its slope to the gradients'.
void sum_windows(const RefinerScene& scene, const SurfaceField& field, const Window& window, int radius,
                 ThreadPool& pool, WarpTerms& terms, WindowSums& sums) {
  const int w = window.width;
  Warped warped{sums.left, terms.residual, terms.gradient, terms.mask};
  pool.for_each(window.height, kBands, [&](int y) {
    warp_row(scene, field, window, y, warped);
    multiply_row(sums.left.row(y), sums.left.row(y), w, sums.left_left.row(y));
    multiply_row(terms.residual.row(y), terms.residual.row(y), w, sums.right_right.row(y));
    multiply_row(sums.left.row(y), terms.residual.row(y), w, sums.left_right.row(y));
  });
  box_sum(terms.mask, radius, pool, sums.across, sums.count);
  box_sum(sums.left, radius, pool, sums.across, sums.left);
  box_sum(terms.residual, radius, pool, sums.across, sums.right);
  box_sum(sums.left_left, radius, pool, sums.across, sums.left_left);
  box_sum(sums.right_right, radius, pool, sums.across, sums.right_right);
  box_sum(sums.left_right, radius, pool, sums.across, sums.left_right);
}

// Of the right view over the left, over the whole face.
float gain_of(const WindowSums& sums, const Plane<float>& mask) {
  double all_left = 0;
  double all_right = 0;
  for (std::size_t k = 0; k < sums.count.values.size(); k += 7) {
    const float n = sums.count.values[k];
    if (n < 30 || mask.values[k] == 0) continue;
    all_left += sums.left_left.values[k] / n - (sums.left.values[k] / n) * (sums.left.values[k] / n);
    all_right += sums.right_right.values[k] / n - (sums.right.values[k] / n) * (sums.right.values[k] / n);
  }
  // Of pictures without any contrast, a covered lens say, rounding leaves variances below zero.
  all_left = std::max(all_left, 0.0);
  all_right = std::max(all_right, 0.0);
  return float(std::clamp(std::sqrt((all_right + 1e-6) / (all_left + 1e-6)), 0.3, 3.0));
}

void form_residuals(const RefinerScene& scene, const Window& window, WindowSums& sums, ThreadPool& pool,
                    WarpTerms& terms, SigmaTerms* for_sigma) {
  const int w = window.width;
  const float gain = gain_of(sums, terms.mask);
  const float level_scale = 1.0F / float(1 << scene.level);
  pool.for_each(window.height, kBands, [&](int y) {
    const Moments m{sums.count.row(y),     sums.left.row(y),        sums.right.row(y),
                    sums.left_left.row(y), sums.right_right.row(y), sums.left_right.row(y)};
    // Where nobody asks for them product and ratio go to rows that have had their day.
    const RowTerms out{terms.residual.row(y), terms.gradient.row(y), terms.cost.row(y),
                       for_sigma != nullptr ? for_sigma->agreed.row(y) : sums.right_right.row(y),
                       for_sigma != nullptr ? for_sigma->ratio.row(y) : sums.right.row(y)};
    const RowViews views{terms.mask.row(y), scene.left.row(window.y0 + y) + window.x0, terms.residual.row(y),
                         terms.gradient.row(y)};
    // A pixel on the picture's own edge has no slope, and the mask is 0 there.
    const int begin_x = window.x0 == 0 ? 1 : 0;
    const int end_x = window.x0 + w == scene.left.width ? w - 1 : w;
    residual_row(m, views, begin_x, end_x, level_scale, gain, 16.0F, out);
    for (const int x : {0, w - 1})
      if (x < begin_x || x >= end_x) out.residual[x] = out.gradient[x] = out.agreed[x] = 0, out.cost[x] = 1;
  });
}

// By the noise of the pixels around, and by the whole surface's at least.
void weigh(ThreadPool& pool, WarpTerms& terms, WindowSums& sums) {
  const int w = terms.mask.width;
  const int h = terms.mask.height;
  Plane<float>& squares = sums.right_right;
  Plane<float>& count = sums.left_left;
  const float least = noise_variance(terms);  // of the residual over the whole surface
  pool.for_each(h, kBands, [&](int y) {
    multiply_row(terms.residual.row(y), terms.residual.row(y), w, squares.row(y));
  });
  box_sum(squares, kNoiseRadius, pool, sums.across, squares);
  box_sum(terms.mask, kNoiseRadius, pool, sums.across, count);
  pool.for_each(h, kBands, [&](int y) {
    for (int x = 0; x < w; ++x) {
      const float local = squares.row(y)[x] / std::max(count.row(y)[x], 1.0F);
      terms.weight.row(y)[x] = terms.mask.row(y)[x] / std::max(local, least);
    }
  });
}

}  // namespace

void form_terms(const RefinerScene& scene, const SurfaceRefinerOptions& options, const SurfaceField& field,
                const Window& window, StageContext& context, WarpTerms& terms, SigmaTerms* for_sigma) {
  Arena::Mark mark(context.scratch);
  const int radius = std::max(kSmallestWindowPx, options.local_window_px >> scene.level) / 2;
  WindowSums sums{{&context.scratch, terms.shape.width, terms.shape.height}, terms};
  sum_windows(scene, field, window, radius, context.pool, terms, sums);
  form_residuals(scene, window, sums, context.pool, terms, for_sigma);
  // The offset soaks up what a slope of shading says: so must the gradient's own mean.
  Plane<float>& gradient = sums.left;
  box_sum(terms.gradient, radius, context.pool, sums.across, gradient);
  context.pool.for_each(terms.mask.height, kBands, [&](int y) {
    for (int x = 0; x < terms.mask.width; ++x) {
      const float mean = terms.mask.row(y)[x] * gradient.row(y)[x] / std::max(sums.count.row(y)[x], 1.0F);
      terms.gradient.row(y)[x] -= mean;
      if (for_sigma != nullptr) for_sigma->agreed.row(y)[x] -= mean * mean;
    }
  });
  weigh(context.pool, terms, sums);
}

}  // namespace relievo::pipeline

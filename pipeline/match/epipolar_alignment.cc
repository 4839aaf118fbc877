// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/epipolar_alignment.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>

#include "pipeline/match/box_filter.h"

namespace relievo::pipeline {
namespace {

constexpr int kBands = 16;
constexpr int kRadius = 6;         // offsets between the views are constant over this reach, level pixels
constexpr int kRounds = 6;
constexpr double kCutGrey = 8;     // a residual beyond this is a highlight or another surface

// The picture minus its local mean: exposure and shading differ between the views, detail does not.
void high_pass(const Plane<float>& from, StageContext& context, Plane<float>& to) {
  Arena::Mark mark(context.scratch);
  Plane<float> across(&context.scratch, from.width, from.height);
  box_sum(from, kRadius, context.pool, across, to);
  constexpr float kScale = 1.0F / ((2 * kRadius + 1) * (2 * kRadius + 1));
  for (std::size_t k = 0; k < to.values.size(); ++k) to.values[k] = from.values[k] - kScale * to.values[k];
}

struct Normal {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double shift2 = 0;
  double count = 0;
};

struct Views {
  const Plane<float>& left;
  const Plane<float>& right;
  int level;
};

// One node's say; false where the right view does not reach.
void add_node(const Views& views, const SurfaceField& field, const VerticalShift& shift, int i, int j, Normal& normal) {
  const int step = field.step_px >> views.level;
  const double scale = 1 << views.level;
  const int x = i * step;
  const int y = j * step;
  const double xr = x - field.disparity_px.row(j)[i] / scale;
  const double v = shift.at(xr * scale, y * scale) / scale;
  const double yr = y + v;
  const int ix = static_cast<int>(std::floor(xr));
  const int iy = static_cast<int>(std::floor(yr));
  const int margin = kRadius + 1;
  if (ix < margin || iy < margin || ix + 1 + margin >= views.right.width || iy + 1 + margin >= views.right.height ||
      x < margin || y < margin || x + margin >= views.left.width || y + margin >= views.left.height) return;
  const double tx = xr - ix;
  const double ty = yr - iy;
  const auto column = [&](int dy) {
    const float* row = views.right.row(iy + dy) + ix;
    return row[0] * (1 - tx) + row[1] * tx;
  };
  const double upper = column(0);
  const double lower = column(1);
  const double residual = upper + ty * (lower - upper) - views.left.row(y)[x];
  if (std::abs(residual) > kCutGrey) return;
  const double slope = 0.5 * (lower - upper) + 0.25 * (views.left.row(y + 1)[x] - views.left.row(y - 1)[x]);
  const Eigen::Vector3d basis(1, xr * scale - shift.centre_x_px, y * scale - shift.centre_y_px);
  normal.a += slope * slope * basis * basis.transpose();
  normal.b -= slope * residual * scale * basis;
  normal.shift2 += v * v * scale * scale;
  normal.count += 1;
}

}  // namespace

VerticalShift measure_vertical_shift(const Plane<float>& left, const Plane<float>& right, int level,
                                     const SurfaceField& field, StageContext& context) {
  Arena::Mark mark(context.scratch);
  Plane<float> left_detail(&context.scratch, left.width, left.height);
  Plane<float> right_detail(&context.scratch, right.width, right.height);
  high_pass(left, context, left_detail);
  high_pass(right, context, right_detail);
  const Views views{left_detail, right_detail, level};
  VerticalShift shift;
  shift.centre_x_px = 0.5 * right.width * (1 << level);
  shift.centre_y_px = 0.5 * right.height * (1 << level);
  for (int round = 0; round < kRounds; ++round) {
    std::array<Normal, kBands> parts;
    context.pool.for_each_band(field.domain.height, kBands, [&](int begin, int end, int band) {
      for (int j = begin; j < end; ++j)
        for (int i = 0; i < field.domain.width; ++i)
          if (field.domain.row(j)[i] != 0) add_node(views, field, shift, i, j, parts[static_cast<std::size_t>(band)]);
    });
    Normal all;
    for (const Normal& part : parts) {
      all.a += part.a;
      all.b += part.b;
      all.shift2 += part.shift2;
      all.count += part.count;
    }
    if (all.count < 500) return {};
    // A faint pull to zero keeps slopes that the face cannot tell (all texture on one row) where they were.
    all.a.diagonal() += Eigen::Vector3d(1, 1e4, 1e4);
    const Eigen::Vector3d step = all.a.ldlt().solve(all.b);
    shift.offset_px += step(0);
    shift.per_x += step(1);
    shift.per_y += step(2);
    shift.rms_px = std::sqrt(all.shift2 / all.count);
  }
  return shift;
}

void shift_rows(const VerticalShift& shift, int level, Plane<float>& right, StageContext& context) {
  Arena::Mark mark(context.scratch);
  Plane<float> copy(&context.scratch, right.width, right.height);
  copy.values = right.values;
  const double scale = 1 << level;
  context.pool.for_each_band(right.height, kBands, [&](int begin, int end, int) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < right.width; ++x) {
        const double at = y + shift.at(x * scale, y * scale) / scale;
        const int k = static_cast<int>(std::floor(at));
        if (k < 1 || k + 2 >= right.height) continue;
        const auto t = static_cast<float>(at - k);
        const float p0 = copy.row(k - 1)[x], p1 = copy.row(k)[x], p2 = copy.row(k + 1)[x], p3 = copy.row(k + 2)[x];
        const float a = 0.5F * (p2 - p0);
        const float b = p0 - 2.5F * p1 + 2 * p2 - 0.5F * p3;
        const float c = 0.5F * (p3 - p0) + 1.5F * (p1 - p2);
        right.row(y)[x] = p1 + t * (a + t * (b + t * c));
      }
  });
}

}  // namespace relievo::pipeline

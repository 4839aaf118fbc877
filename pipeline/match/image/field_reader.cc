// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/image/field_reader.h"

#include <algorithm>
#include <cmath>

namespace relievo::pipeline {
namespace {

constexpr float kSameSurface = 2;

float scatter_about_plane(const Plane<float>& field, int x, int y, float nothing) {
  const float middle = field.row(y)[x];
  double n = 0, u = 0, v = 0, d = 0, uu = 0, uv = 0, vv = 0, ud = 0, vd = 0, dd = 0;
  for (int j = -2; j <= 2; ++j)
    for (int i = -2; i <= 2; ++i) {
      if (x + i < 0 || y + j < 0 || x + i >= field.width || y + j >= field.height) continue;
      const float value = field.row(y + j)[x + i];
      if (value <= nothing || std::abs(value - middle) > kSameSurface) continue;
      const auto e = double(value - middle);
      n += 1;
      u += i;
      v += j;
      d += e;
      uu += i * i;
      uv += i * j;
      vv += j * j;
      ud += i * e;
      vd += j * e;
      dd += e * e;
    }
  if (n < 6) return kSameSurface;
  uu -= u * u / n;
  uv -= u * v / n;
  vv -= v * v / n;
  ud -= u * d / n;
  vd -= v * d / n;
  dd -= d * d / n;
  const double det = uu * vv - uv * uv;
  if (!(det > 1e-9)) return kSameSurface;
  const double a = (ud * vv - vd * uv) / det;
  const double b = (vd * uu - ud * uv) / det;
  return float(std::sqrt(std::max(0.0, dd - a * ud - b * vd) / (n - 3)));
}

}  // namespace

FieldReading read_disparity(const Plane<float>& field, Vec2f at, float nothing) {
  FieldReading reading;
  const int nearest_x = int(std::lround(at.x));
  const int nearest_y = int(std::lround(at.y));
  if (nearest_x < 0 || nearest_y < 0 || nearest_x >= field.width || nearest_y >= field.height) return reading;
  const float nearest = field.row(nearest_y)[nearest_x];
  if (nearest <= nothing) return reading;
  reading.known = true;
  reading.disparity = nearest;
  reading.scatter = scatter_about_plane(field, nearest_x, nearest_y, nothing);
  const int x = int(std::floor(at.x));
  const int y = int(std::floor(at.y));
  if (x < 0 || y < 0 || x + 1 >= field.width || y + 1 >= field.height) return reading;
  const float* upper = field.row(y) + x;
  const float* lower = field.row(y + 1) + x;
  const auto [least, most] = std::minmax({upper[0], upper[1], lower[0], lower[1]});
  if (least <= nothing || most - least > 1) return reading;
  const float tx = at.x - float(x);
  const float ty = at.y - float(y);
  const float top = upper[0] + tx * (upper[1] - upper[0]);
  const float low = lower[0] + tx * (lower[1] - lower[0]);
  reading.disparity = top + ty * (low - top);
  return reading;
}

}  // namespace relievo::pipeline

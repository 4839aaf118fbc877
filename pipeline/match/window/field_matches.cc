// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/window/field_matches.h"

#include <algorithm>
#include <cmath>

#include "pipeline/match/window/window_correlation.h"

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

struct FieldReading {
  bool known = false;
  float disparity = 0;  // pixels of the field
  float scatter = 0;    // rms about the plane of 5 x 5 pixels, of those within 2 pixels of the middle
};

// `at` in pixels of the field. Bilinear between four that lie on one surface (within a pixel of each
// other), else the nearest. Values of `nothing` and below are unknown.
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

}  // namespace

Result<MatchSet> matches_in_field(const DisparityField& field, const RectifiedPair& pair,
                                  const Keypoints& keypoints, StageContext& context) {
  constexpr int kRadius = 4, kBandsOfPlaces = 32;
  constexpr float kFitSigmaPx = 1.0F / 6;  // of the fit between pixels, pixels of the field
  MatchSet set(&context.output);
  set.lattice_step_px = keypoints.lattice_step_px;
  set.matches.reserve(keypoints.points.size());
  std::pmr::vector<Match> found(keypoints.points.size(), Match{}, &context.scratch);
  context.pool.for_each_band(int(found.size()), kBandsOfPlaces, [&](int begin, int end, int) {
    for (int k = begin; k < end && !context.stop(); ++k) {
      const Vec2f at = keypoints.points[std::size_t(k)].at_px;
      const Vec2f in_field{(at.x - field.corner_px.x) / field.scale,
                           (at.y - field.corner_px.y) / field.scale};
      const FieldReading reading = read_disparity(field.values, in_field, field.nothing);
      if (!reading.known) continue;
      const float d = field.scale * reading.disparity;
      found[std::size_t(k)] = {at, d, window_cost(pair, at, d, kRadius),
                               field.scale * std::hypot(kFitSigmaPx, reading.scatter), 0};
    }
  });
  if (context.stop()) return Error{Errc::Cancelled, "stopped while matching"};
  for (const Match& match : found)
    if (match.sigma_px > 0 && match.cost < 1) set.matches.push_back(match);
  if (set.matches.empty()) return nothing_matches();
  return set;
}

Error nothing_matches() {
  return {Errc::TooFewMatches,
          "hardly anything matches between the views: is the face in both, in focus and lit?"};
}

}  // namespace relievo::pipeline

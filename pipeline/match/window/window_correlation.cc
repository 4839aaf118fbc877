// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/window/window_correlation.h"

#include <algorithm>
#include <cmath>

namespace relievo::pipeline {
namespace {

struct Sampler {
  Sampler(const RectifiedPair& pair, const RectifiedView& view, Vec2f at, int radius)
      : view_(view),
        width_(pair.width_px),
        x_(int(std::floor(at.x))),
        y_(int(std::floor(at.y))),
        tx_(double(at.x) - x_),
        ty_(double(at.y) - y_),
        inside_(x_ >= radius && y_ >= radius && x_ + radius + (tx_ > 0 ? 1 : 0) < pair.width_px &&
                y_ + radius + (ty_ > 0 ? 1 : 0) < pair.height_px) {}

  bool inside() const { return inside_; }
  // False where a pixel is not valid.
  bool at(int i, int j, double& value) const {
    const std::size_t k = std::size_t(y_ + j) * std::size_t(width_) + std::size_t(x_ + i);
    const std::size_t right = k + (tx_ > 0 ? 1 : 0);
    const std::size_t down = ty_ > 0 ? std::size_t(width_) : 0;
    if ((view_.valid[k] & view_.valid[right] & view_.valid[k + down] & view_.valid[right + down]) == 0)
      return false;
    const double top = (1 - tx_) * double(view_.grey[k]) + tx_ * double(view_.grey[right]);
    const double low = (1 - tx_) * double(view_.grey[k + down]) + tx_ * double(view_.grey[right + down]);
    value = (1 - ty_) * top + ty_ * low;
    return true;
  }

 private:
  const RectifiedView& view_;
  int width_, x_, y_;
  double tx_, ty_;
  bool inside_;
};

constexpr float kSameSurface = 2;

float scatter_about_plane(const Plane<float>& field, int x, int y) {
  const float middle = field.row(y)[x];
  double n = 0, u = 0, v = 0, d = 0, uu = 0, uv = 0, vv = 0, ud = 0, vd = 0, dd = 0;
  for (int j = -2; j <= 2; ++j)
    for (int i = -2; i <= 2; ++i) {
      if (x + i < 0 || y + j < 0 || x + i >= field.width || y + j >= field.height) continue;
      const float value = field.row(y + j)[x + i];
      if (value <= kNoDisparity || std::abs(value - middle) > kSameSurface) continue;
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
// other), else the nearest.
FieldReading read_disparity(const Plane<float>& field, Vec2f at) {
  FieldReading reading;
  const int nearest_x = int(std::lround(at.x));
  const int nearest_y = int(std::lround(at.y));
  if (nearest_x < 0 || nearest_y < 0 || nearest_x >= field.width || nearest_y >= field.height) return reading;
  const float nearest = field.row(nearest_y)[nearest_x];
  if (nearest <= kNoDisparity) return reading;
  reading.known = true;
  reading.disparity = nearest;
  reading.scatter = scatter_about_plane(field, nearest_x, nearest_y);
  const int x = int(std::floor(at.x));
  const int y = int(std::floor(at.y));
  if (x < 0 || y < 0 || x + 1 >= field.width || y + 1 >= field.height) return reading;
  const float* upper = field.row(y) + x;
  const float* lower = field.row(y + 1) + x;
  const auto [least, most] = std::minmax({upper[0], upper[1], lower[0], lower[1]});
  if (least <= kNoDisparity || most - least > 1) return reading;
  const float tx = at.x - float(x);
  const float ty = at.y - float(y);
  const float top = upper[0] + tx * (upper[1] - upper[0]);
  const float low = lower[0] + tx * (lower[1] - lower[0]);
  reading.disparity = top + ty * (low - top);
  return reading;
}

}  // namespace

std::optional<Match> match_on_row(const RectifiedPair& pair, Vec2f left_px, double least_px, double most_px,
                                  int radius) {
  const double wide = pair.width_px;
  const int first = int(std::ceil(std::clamp(least_px, -wide, wide))),
            last = int(std::floor(std::clamp(most_px, -wide, wide)));
  const auto alike = [&](int disparity) {
    return window_correlation(pair, left_px, {left_px.x - float(disparity), left_px.y}, radius);
  };
  double best = 0;
  int at = first;
  for (int d = first; d <= last; ++d)
    if (const double here = alike(d); here > best) best = here, at = d;
  if (at == first || at >= last) return std::nullopt;
  const double before = alike(at - 1), after = alike(at + 1), bend = 2 * best - before - after;
  if (!(bend > 0)) return std::nullopt;
  const double samples = (2 * radius + 1) * (2 * radius + 1);
  const double unlike = std::max(1 - best, 1e-6 * bend);
  return Match{
      left_px, float(at + (after - before) / (2 * bend)), float(1 - best),
      float(std::hypot(std::sqrt(2 * unlike / (samples * bend)), method_bias_px(pair, 2 * radius + 1))), 0};
}

double window_correlation(const RectifiedPair& pair, Vec2f left_px, Vec2f right_px, int radius) {
  if (!std::isfinite(left_px.x + left_px.y + right_px.x + right_px.y) || std::abs(left_px.x) > 1e6F ||
      std::abs(right_px.x) > 1e6F || std::abs(left_px.y) > 1e6F || std::abs(right_px.y) > 1e6F)
    return 0;
  const Sampler left(pair, pair.left, left_px, radius);
  const Sampler right(pair, pair.right, right_px, radius);
  if (!left.inside() || !right.inside()) return 0;
  double l = 0, r = 0, ll = 0, rr = 0, lr = 0;
  for (int j = -radius; j <= radius; ++j)
    for (int i = -radius; i <= radius; ++i) {
      double a = 0;
      double b = 0;
      if (!left.at(i, j, a) || !right.at(i, j, b)) return 0;
      l += a;
      r += b;
      ll += a * a;
      rr += b * b;
      lr += a * b;
    }
  const double n = (2 * radius + 1) * (2 * radius + 1);
  const double scale = std::sqrt(std::max(0.0, ll - l * l / n) * std::max(0.0, rr - r * r / n));
  return scale > 1e-3 * n ? std::clamp((lr - l * r / n) / scale, -1.0, 1.0) : 0;
}

float window_cost(const RectifiedPair& pair, Vec2f left_px, float disparity_px, int radius) {
  return float(std::clamp(
      1 - window_correlation(pair, left_px, {left_px.x - disparity_px, left_px.y}, radius), 0.0, 1.0));
}

Result<MatchSet> matches_in_field(const DisparityField& field, const RectifiedPair& pair,
                                  const Keypoints& keypoints, StageContext& context) {
  constexpr int kRadius = 4, kBandsOfPlaces = 32;
  constexpr float kFitSigmaPx = 1.0F / 6;  // of the fit between pixels, pixels of the field
  std::pmr::vector<Match> found(keypoints.points.size(), Match{}, &context.scratch);
  context.pool.for_each(int(found.size()), kBandsOfPlaces, [&](int k) {
    if (context.stop()) return;
    const Vec2f at = keypoints.points[std::size_t(k)].at_px;
    const Vec2f in_field{(at.x - field.corner_px.x) / field.scale, (at.y - field.corner_px.y) / field.scale};
    const FieldReading reading = read_disparity(field.values, in_field);
    if (!reading.known) return;
    const float d = field.scale * reading.disparity;
    if (const float cost = window_cost(pair, at, d, kRadius); cost < 1)
      found[std::size_t(k)] = {at, d, cost, field.scale * std::hypot(kFitSigmaPx, reading.scatter), 0};
  });
  if (context.stop()) return stopped();
  return matches_of(found, keypoints, context);
}

Result<MatchSet> matches_of(std::span<const Match> found, const Keypoints& keypoints, StageContext& context) {
  MatchSet set(&context.output);
  set.lattice_step_px = keypoints.lattice_step_px;
  set.matches.reserve(keypoints.points.size());
  for (const Match& match : found)
    if (match.sigma_px > 0) set.matches.push_back(match);
  if (set.matches.empty()) return nothing_matches();
  return set;
}

Error nothing_matches() {
  return {Errc::TooFewMatches,
          "hardly anything matches between the views: is the face in both, in focus and lit?"};
}

}  // namespace relievo::pipeline

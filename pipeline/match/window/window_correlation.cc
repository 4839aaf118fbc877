// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/window/window_correlation.h"

#include <algorithm>
#include <cmath>

#include "pipeline/match/window/window_matching.h"

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

}  // namespace relievo::pipeline

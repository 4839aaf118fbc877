// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/bench/show/touched_point.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace relievo::firmware {
namespace {

constexpr int kHalfWindowPx = 7;       // of the likeness
constexpr float kFingerShare = 0.02F;  // of the picture's width: what a finger may miss a match by
constexpr float kSnapShare = 0.02F;    // and a partner

void place(const pipeline::RectifiedPair& pair, ui::BenchPoint& point) {
  point.right_px = {point.left_px.x - point.disparity_px, point.left_px.y};
  point.left_x = point.left_px.x / static_cast<float>(pair.width_px);
  point.right_x = point.right_px.x / static_cast<float>(pair.width_px);
  point.y = point.left_px.y / static_cast<float>(pair.height_px);
}

// As RectifiedPair says it.
void reconstruct(const pipeline::RectifiedPair& pair, ui::BenchPoint& point) {
  const double z = pair.depth_mm(point.disparity_px);
  if (!std::isfinite(z) || z <= 0) return;
  const double across = (point.left_px.x - pair.left_centre_px.x) / pair.focal_px,
               down = (point.left_px.y - pair.left_centre_px.y) / pair.focal_px;
  const pipeline::Vec3d p =
      apply(transposed(pair.rectified_from_left), pipeline::Vec3d{across * z, down * z, z});
  point.at_mm = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  const double slant = std::sqrt(1 + across * across + down * down);
  point.sigma_mm = static_cast<float>(z * z / (pair.focal_px * pair.baseline_mm) * point.sigma_px * slant);
}

// The window of one view around a place on a row, bilinear along the row.
struct Patch {
  static constexpr int kSide = 2 * kHalfWindowPx + 1;
  std::array<double, std::size_t{kSide} * kSide> grey{};
  double mean = 0, energy = 0;
};

bool cut(const pipeline::RectifiedPair& pair, const pipeline::RectifiedView& view, double x, int y,
         Patch& patch) {
  const double first = std::floor(x);
  const int u = static_cast<int>(first);
  if (u < kHalfWindowPx || y < kHalfWindowPx || u + kHalfWindowPx + 1 >= pair.width_px ||
      y + kHalfWindowPx >= pair.height_px)
    return false;
  std::size_t i = 0;
  patch.mean = patch.energy = 0;
  for (int v = -kHalfWindowPx; v <= kHalfWindowPx; ++v) {
    const float* row = view.grey.data() + static_cast<std::ptrdiff_t>(y + v) * pair.width_px + u;
    for (int k = -kHalfWindowPx; k <= kHalfWindowPx; ++k) {
      const double at = (1 - (x - first)) * row[k] + (x - first) * row[k + 1];
      patch.grey[i++] = at;
      patch.mean += at;
    }
  }
  patch.mean /= static_cast<double>(patch.grey.size());
  for (double& g : patch.grey) {
    g -= patch.mean;
    patch.energy += g * g;
  }
  return patch.energy > 0;
}

double correlation(const Patch& a, const Patch& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.grey.size(); ++i) sum += a.grey[i] * b.grey[i];
  return sum / std::sqrt(a.energy * b.energy);
}

// Of a shift along the row between two patches that differ by noise alone: noise / root of the summed squared
// slopes.
double sigma_of(const Patch& patch, double rho) {
  double slopes = 0;
  for (int v = 0; v < Patch::kSide; ++v) {
    for (int u = 1; u + 1 < Patch::kSide; ++u) {
      const auto i = static_cast<std::size_t>(v * Patch::kSide + u);
      const double slope = (patch.grey[i + 1] - patch.grey[i - 1]) / 2;
      slopes += slope * slope;
    }
  }
  const double noise =
      (1 - rho * rho) * patch.energy / static_cast<double>(patch.grey.size());  // of the difference
  return slopes > 0 ? std::sqrt(std::max(noise, 0.25) / slopes) : 1;
}

}  // namespace

ui::BenchPoint nearest_match(const pipeline::RectifiedPair& pair, const pipeline::MatchSet& matches,
                             const BenchFigures& figures, float x, float y) {
  ui::BenchPoint point = hand_point(pair, x, y);
  point.by_hand = point.waits_for_right = false;
  const float reach = kFingerShare * static_cast<float>(pair.width_px);
  float best = reach * reach;
  const pipeline::Match* nearest = nullptr;
  for (const pipeline::Match& m : matches.matches) {
    const float dx = m.left_px.x - point.left_px.x, dy = m.left_px.y - point.left_px.y, d = dx * dx + dy * dy;
    if (d >= best) continue;
    best = d;
    nearest = &m;
  }
  if (nearest == nullptr) return point;
  point.matched = true;
  point.left_px = nearest->left_px;
  point.disparity_px = nearest->disparity_px;
  point.sigma_px = nearest->sigma_px;
  point.cost = nearest->cost;
  const auto rule = static_cast<std::size_t>(std::countr_zero(nearest->rejected_by));
  if (nearest->rejected_by != 0)
    point.rejected_by = rule < figures.rule_count() ? std::string_view(figures.rule(rule)) : "?";
  place(pair, point);
  reconstruct(pair, point);
  return point;
}

ui::BenchPoint hand_point(const pipeline::RectifiedPair& pair, float x, float y) {
  ui::BenchPoint point;
  point.touched = point.by_hand = point.waits_for_right = true;
  point.left_px = {std::clamp(x, 0.0F, 1.0F) * static_cast<float>(pair.width_px),
                   std::clamp(y, 0.0F, 1.0F) * static_cast<float>(pair.height_px)};
  point.left_x = x;
  point.y = y;
  return point;
}

void match_by_hand(const pipeline::RectifiedPair& pair, float right_x, ui::BenchPoint& point) {
  Patch left, right;
  const int row = static_cast<int>(std::lround(point.left_px.y));
  if (!cut(pair, pair.left, point.left_px.x, row, left)) return;
  const double middle = static_cast<double>(right_x) * pair.width_px;
  const int reach = std::max(2, static_cast<int>(kSnapShare * static_cast<float>(pair.width_px)));
  double best = -2;
  int at = 0;
  for (int step = -reach; step <= reach; ++step) {
    if (!cut(pair, pair.right, middle + step, row, right)) continue;
    const double rho = correlation(left, right);
    if (rho > best) best = rho, at = step;
  }
  if (best < -1) return;
  const auto rho_at = [&](int step) {
    return cut(pair, pair.right, middle + step, row, right) ? correlation(left, right) : best;
  };
  const double before = rho_at(at - 1), after = rho_at(at + 1), bend = before - 2 * best + after;
  const double part = bend < 0 ? std::clamp((before - after) / (2 * bend), -0.5, 0.5) : 0;
  point.matched = true;
  point.waits_for_right = false;
  point.disparity_px = point.left_px.x - static_cast<float>(middle + at + part);
  point.cost = static_cast<float>(1 - best);
  point.sigma_px = static_cast<float>(sigma_of(left, best));
  place(pair, point);
  reconstruct(pair, point);
}

}  // namespace relievo::firmware

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/blend/view_blend.h"

#include <algorithm>
#include <cmath>

namespace relievo::pipeline {
namespace {

constexpr int kEvery = 5;  // texels between samples
constexpr int kDark = 8;   // black and blown-out pixels say nothing about exposure
constexpr int kBright = 246;
constexpr int kRounds = 8;

template <typename Visit>
void for_each_sample(const Chart& chart, const ShotPlanes& planes, std::size_t channel, Visit&& visit) {
  for (int y = 0; y < chart.height_px; y += kEvery)
    for (int x = 0; x < chart.width_px; x += kEvery) {
      const std::size_t k = chart.index(x, y);
      if (planes.say_left[k] < 255 || planes.say_right[k] < 255) continue;
      const std::uint8_t l = planes.left[3 * k + channel];
      const std::uint8_t r = planes.right[3 * k + channel];
      if (std::min(l, r) >= kDark && std::max(l, r) <= kBright) visit(double(l), double(r));
    }
}

// 1.4826 times the median of the absolute residuals, from a histogram of quarters of a grey level.
double robust_sigma(const Chart& chart, const ShotPlanes& planes, std::size_t channel, double gain,
                    double offset) {
  std::array<int, 1024> histogram{};
  int count = 0;
  for_each_sample(chart, planes, channel, [&](double l, double r) {
    ++histogram[std::size_t(std::min(1023.0, 4 * std::abs(l - gain * r - offset)))];
    ++count;
  });
  int below = 0;
  for (std::size_t bin = 0; bin < histogram.size(); ++bin) {
    below += histogram[bin];
    if (2 * below >= count) return 1.4826 * (double(bin) + 0.5) / 4;
  }
  return 0;
}

struct Moments {
  double weight = 0, l = 0, r = 0, ll = 0, rr = 0, lr = 0;
};

Moments weighted_moments(const Chart& chart, const ShotPlanes& planes, std::size_t channel, double gain,
                         double offset, double limit) {
  Moments m;
  for_each_sample(chart, planes, channel, [&](double l, double r) {
    const double u = (l - gain * r - offset) / limit;
    if (std::abs(u) >= 1) return;
    const double w = (1 - u * u) * (1 - u * u);
    m.weight += w;
    m.l += w * l;
    m.r += w * r;
    m.ll += w * l * l;
    m.rr += w * r * r;
    m.lr += w * l * r;
  });
  return m;
}

constexpr int kLevelCell = 16;  // texels a cell and side

// Weighted means with the neighbours (binomial, twice): normalised convolution.
void smooth(Plane<LevelSum>& cells, std::pmr::memory_resource* memory) {
  Plane<LevelSum> next(memory, cells.width, cells.height);
  for (int pass = 0; pass < 2; ++pass) {
    for (int y = 0; y < cells.height; ++y)
      for (int x = 0; x < cells.width; ++x) {
        LevelSum sum;
        for (int v = std::max(0, y - 1); v <= std::min(cells.height - 1, y + 1); ++v)
          for (int u = std::max(0, x - 1); u <= std::min(cells.width - 1, x + 1); ++u)
            sum.add(cells.row(v)[u], (u == x ? 2.0F : 1.0F) * (v == y ? 2.0F : 1.0F) / 16);
        next.row(y)[x] = sum;
      }
    std::swap(cells.values, next.values);
  }
}

// Cells nobody knows take the mean of what is known in ever larger squares around them; a few grey
// levels of evidence count as known, so that a cell at the border is not its one texel's slave.
Plane<Level> extended(const Plane<LevelSum>& cells, std::pmr::memory_resource* memory) {
  constexpr float kEnough = 32;  // texels
  Plane<Level> field(memory, cells.width, cells.height);
  const int largest = std::max(cells.width, cells.height);
  for (int y = 0; y < cells.height; ++y)
    for (int x = 0; x < cells.width; ++x) {
      LevelSum sum = cells.row(y)[x];
      for (int radius = 1; sum.weight < kEnough && radius <= largest; radius *= 2) {
        sum = {};
        for (int v = std::max(0, y - radius); v <= std::min(cells.height - 1, y + radius); ++v)
          for (int u = std::max(0, x - radius); u <= std::min(cells.width - 1, x + radius); ++u)
            sum.add(cells.row(v)[u], 1);
      }
      for (std::size_t c = 0; c < 3 && sum.weight > 0; ++c) field.row(y)[x][c] = sum.sum[c] / sum.weight;
    }
  return field;
}

}  // namespace

ExposureMatch match_exposure(const Chart& chart, const ShotPlanes& planes) {
  constexpr double kTukey = 4.685;
  constexpr double kLeastSpread = 6;  // grey levels: below, skin is too even to tell gain from offset
  ExposureMatch match;
  for (std::size_t c = 0; c < 3; ++c) {
    Moments m = weighted_moments(chart, planes, c, 1, 0, 1e9);
    if (m.weight < 100) continue;
    double gain = std::clamp(m.l / m.r, 0.25, 4.0);
    double offset = 0;
    double sigma = 0;
    for (int round = 0; round < kRounds; ++round) {
      sigma = std::max(robust_sigma(chart, planes, c, gain, offset), 0.5);
      m = weighted_moments(chart, planes, c, gain, offset, kTukey * sigma);
      if (m.weight < 100) break;
      const double l = m.l / m.weight;
      const double r = m.r / m.weight;
      const double spread_l = std::sqrt(std::max(m.ll / m.weight - l * l, 0.0));
      const double spread_r = std::sqrt(std::max(m.rr / m.weight - r * r, 0.0));
      const bool tells = spread_r > kLeastSpread && spread_l > kLeastSpread &&
                         m.lr / m.weight - l * r > 0.5 * spread_l * spread_r;
      gain = std::clamp(tells ? spread_l / spread_r : l / r, 0.25, 4.0);
      offset = tells ? std::clamp(l - gain * r, -64.0, 64.0) : 0.0;
    }
    match.gain[c] = float(gain);
    match.offset[c] = float(offset);
    match.sigma[c] = float(sigma);
  }
  return match;
}

Plane<Level> measure_levels(const Chart& chart, const ShotPlanes& planes, const ExposureMatch& exposure,
                            std::span<const std::uint8_t> shines, std::pmr::memory_resource* memory) {
  constexpr float kFarthest = 40;  // grey levels: more is an edge that does not meet, not a level
  Plane<LevelSum> cells(memory, (chart.width_px + kLevelCell - 1) / kLevelCell,
                        (chart.height_px + kLevelCell - 1) / kLevelCell);
  for (int y = 0; y < chart.height_px; ++y)
    for (int x = 0; x < chart.width_px; ++x) {
      const std::size_t k = chart.index(x, y);
      if (std::min(planes.say_left[k], planes.say_right[k]) < 128 || shines[k] != 0) continue;
      LevelSum here{{}, 1};
      for (std::size_t c = 0; c < 3; ++c)
        here.sum[c] = exposure.matched(c, planes.right[3 * k + c]) - float(planes.left[3 * k + c]);
      if (std::abs(here.sum[1]) <= kFarthest) cells.row(y / kLevelCell)[x / kLevelCell].add(here, 1);
    }
  smooth(cells, memory);
  return extended(cells, memory);
}

Level level_at(const Plane<Level>& field, float texel_x, float texel_y) {
  const float x = std::clamp((texel_x + 0.5F) / kLevelCell - 0.5F, 0.0F, float(field.width - 1));
  const float y = std::clamp((texel_y + 0.5F) / kLevelCell - 0.5F, 0.0F, float(field.height - 1));
  const int u = std::min(int(x), std::max(0, field.width - 2));
  const int v = std::min(int(y), std::max(0, field.height - 2));
  const int u1 = std::min(u + 1, field.width - 1);
  const Level *above = field.row(v), *below = field.row(std::min(v + 1, field.height - 1));
  const float fx = x - float(u);
  const float fy = y - float(v);
  Level level;
  for (std::size_t c = 0; c < 3; ++c) {
    const float upper = above[u][c] + fx * (above[u1][c] - above[u][c]);
    const float lower = below[u][c] + fx * (below[u1][c] - below[u][c]);
    level[c] = upper + fy * (lower - upper);
  }
  return level;
}

}  // namespace relievo::pipeline

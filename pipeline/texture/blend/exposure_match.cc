// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/blend/exposure_match.h"

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
      if (std::min(l, r) >= kDark && std::max(l, r) <= kBright)
        visit(static_cast<double>(l), static_cast<double>(r));
    }
}

// 1.4826 times the median of the absolute residuals, from a histogram of quarters of a grey level.
double robust_sigma(const Chart& chart, const ShotPlanes& planes, std::size_t channel, double gain,
                    double offset) {
  std::array<int, 1024> histogram{};
  int count = 0;
  for_each_sample(chart, planes, channel, [&](double l, double r) {
    ++histogram[static_cast<std::size_t>(std::min(1023.0, 4 * std::abs(l - gain * r - offset)))];
    ++count;
  });
  int below = 0;
  for (std::size_t bin = 0; bin < histogram.size(); ++bin) {
    below += histogram[bin];
    if (2 * below >= count) return 1.4826 * (static_cast<double>(bin) + 0.5) / 4;
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
    match.gain[c] = static_cast<float>(gain);
    match.offset[c] = static_cast<float>(offset);
    match.sigma[c] = static_cast<float>(sigma);
  }
  return match;
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/light/face_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace relievo::pipeline {
namespace {

using Histogram = std::array<int, 256>;
constexpr double kHalfWidthMm = 50, kUpMm = 62, kDownMm = 50;  // about the tip of the nose
// The two zones whose histograms are compared: squares of 0.3 eye distances outside of the pupils, half way
// down to the mouth (OFIQ).
constexpr double kPupilMm = 31.5, kZoneMm = 19;
constexpr double kDegree = std::numbers::pi / 180,
                 kCheekDeg = 48;  // a cheek in these zones looks so far aside
constexpr double kMostTurnDeg = 20;
constexpr int kGlossStep = 55;  // levels above the median of the face

Histogram zone(const Relief& relief, const HeadMeasurement& head, double side) {
  Histogram counts{};
  const double step = std::max(0.8, head.tip_mm.z / relief.focal_px);
  for (double right = kPupilMm; right < kPupilMm + kZoneMm; right += step)
    for (double down = -kZoneMm / 2; down < kZoneMm / 2; down += step) {
      const FacePlace at = place_on(relief, head, side * right, down);
      if (at.inside) ++counts[relief.grey[relief.index(at.x, at.y)]];
    }
  return counts;
}

double shared(const Histogram& a, const Histogram& b) {
  double sum_a = 0, sum_b = 0, both = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum_a += a[i], sum_b += b[i];
  if (sum_a == 0 || sum_b == 0) return 0;
  for (std::size_t i = 0; i < a.size(); ++i) both += std::min(a[i] / sum_a, b[i] / sum_b);
  return both;
}

double mean_of(const Histogram& counts) {
  double sum = 0, all = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) sum += static_cast<double>(i) * counts[i], all += counts[i];
  return all > 0 ? sum / all : 0;
}

// Of a cheek's light when the head faces the rig, and with it the lamps, to when it is turned away from that
// cheek by so much (Lambert).
double turned_share(double away_deg) {
  const double turned = std::clamp(away_deg, -kMostTurnDeg, kMostTurnDeg) * kDegree;
  return std::cos(kCheekDeg * kDegree) / std::cos(kCheekDeg * kDegree + turned);
}

int median_of(const Histogram& counts, int all) {
  int seen = 0;
  for (int i = 0; i < 256; ++i)
    if ((seen += counts[static_cast<std::size_t>(i)]) * 2 >= all) return i;
  return 255;
}

}  // namespace

FaceLight measure_light(const Relief& relief, const HeadMeasurement& head) {
  FaceLight light;
  if (!head.known) return light;
  Histogram counts{};
  int all = 0;
  const double step = std::max(1.0, head.tip_mm.z / relief.focal_px);
  for (double down = -kUpMm; down <= kDownMm; down += step)
    for (double right = -kHalfWidthMm; right <= kHalfWidthMm; right += step) {
      const double v = down < 0 ? down / kUpMm : down / kDownMm, u = right / kHalfWidthMm;
      if (u * u + v * v > 1) continue;
      const FacePlace at = place_on(relief, head, right, down);
      if (!at.inside || !relief.known(at.x, at.y)) continue;
      ++counts[relief.grey[relief.index(at.x, at.y)]];
      ++all;
    }
  if (all < 200) return light;
  light.known = true;
  const int gloss = median_of(counts, all) + kGlossStep;
  double mean = 0, square = 0;
  for (int i = 0; i < 256; ++i) {
    const double share = static_cast<double>(counts[static_cast<std::size_t>(i)]) / all;
    mean += share * i / 255.0;
    square += share * i * i / 65025.0;
    if (i <= 25) light.dark_share += share;
    if (i >= 247) light.bright_share += share;
    if (i >= gloss) light.glossy_share += share;
    if (share > 0) light.entropy_bits -= share * std::log2(share);
  }
  light.luminance_mean = mean;
  light.luminance_variance = std::max(0.0, square - mean * mean);
  const Histogram left = zone(relief, head, -1), right = zone(relief, head, 1);
  light.uniformity = shared(left, right);
  const double a = mean_of(left), b = mean_of(right);
  const double lit = b * turned_share(head.yaw_deg),
               other = a * turned_share(-head.yaw_deg);  // as on a head that is not turned
  light.side_ratio = std::max(lit, other) > 0 ? std::min(lit, other) / std::max(lit, other) : 0;
  return light;
}

}  // namespace relievo::pipeline

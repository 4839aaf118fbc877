// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/light/face_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/match/rectify/rectified_geometry.h"

namespace relievo::pipeline {
namespace {

using Histogram = std::array<int, 256>;
constexpr double kHalfWidthMm = 50, kUpMm = 62, kDownMm = 50;  // about the tip of the nose
// The two zones whose histograms are compared: squares of 0.3 eye distances outside of the pupils, half way down to the mouth (OFIQ).
constexpr double kPupilMm = 31.5, kZoneMm = 19;
constexpr int kGlossStep = 55;     // levels above the median of the face
constexpr double kWindowMm = 36;   // half the side of what sharpness is measured on
constexpr double kDetailMm = 0.5;
constexpr int kTiles = 6;

Histogram zone(const Relief& relief, const HeadSight& head, double side) {
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

int median_of(const Histogram& counts, int all) {
  int seen = 0;
  for (int i = 0; i < 256; ++i)
    if ((seen += counts[static_cast<std::size_t>(i)]) * 2 >= all) return i;
  return 255;
}

int luminance(const ImageView& image, int x, int y) {
  const std::uint8_t* row = image.row(y);
  switch (image.format) {
    case PixelFormat::Rgb8: return (row[3 * x] + row[3 * x + 1] + row[3 * x + 2]) / 3;
    case PixelFormat::Grey16: return row[2 * x + 1];
    case PixelFormat::Grey8: break;
  }
  return row[x];
}

}  // namespace

FaceLight measure_light(const Relief& relief, const HeadSight& head) {
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
  light.side_ratio = std::max(a, b) > 0 ? std::min(a, b) / std::max(a, b) : 0;
  return light;
}

double measure_sharpness(const StereoFrame& frame, const StereoCalibration& calibration, const Relief& relief, const HeadSight& head) {
  if (!head.known || frame.left.empty()) return 0;
  const ImageView& image = frame.left;
  // The middle between nose and eyes, in the left camera.
  const Vec3d p{head.tip_mm.x - 18 * head.down.x, head.tip_mm.y - 18 * head.down.y, head.tip_mm.z - 18 * head.down.z};
  const Vec2d at = source_pixel(calibration.left, relief.rectified_from_left, 1, {0, 0}, {p.x / p.z, p.y / p.z});
  const double pixels_a_mm = calibration.left.focal_px.x / p.z;
  const int near = std::max(1, static_cast<int>(std::lround(kDetailMm * pixels_a_mm))), far = 4 * near;
  const int half = static_cast<int>(kWindowMm * pixels_a_mm), stride = std::max(1, half / 60);
  const int x0 = std::max(far, static_cast<int>(at.x) - half), x1 = std::min(image.width_px - far, static_cast<int>(at.x) + half);
  const int y0 = std::max(far, static_cast<int>(at.y) - half), y1 = std::min(image.height_px - far, static_cast<int>(at.y) + half);
  // Tiles, so that the flattest can say what noise is.
  std::array<std::array<double, kTiles * kTiles>, 2> fine{};
  std::array<double, 2> coarse{};
  for (int y = y0; y < y1; y += stride)
    for (int x = x0; x < x1; x += stride) {
      const auto tile = static_cast<std::size_t>((y - y0) * kTiles / (y1 - y0) * kTiles + (x - x0) * kTiles / (x1 - x0));
      const int here = 2 * luminance(image, x, y);
      const int bend[4] = {luminance(image, x - near, y) + luminance(image, x + near, y) - here, luminance(image, x, y - near) + luminance(image, x, y + near) - here,
                           luminance(image, x - far, y) + luminance(image, x + far, y) - here, luminance(image, x, y - far) + luminance(image, x, y + far) - here};
      for (std::size_t k = 0; k < 2; ++k) {
        fine[k][tile] += bend[k] * bend[k];
        coarse[k] += bend[k + 2] * bend[k + 2];
      }
    }
  const auto ratio = [&](std::size_t k) {
    std::sort(fine[k].begin(), fine[k].end());
    double all = 0, flat = 0;
    for (std::size_t i = 0; i < fine[k].size(); ++i) {
      all += fine[k][i];
      if (i < fine[k].size() / 4) flat += 4 * fine[k][i];
    }
    return coarse[k] > 0 ? std::max(0.0, all - flat) / coarse[k] : 0;
  };
  return std::min(ratio(0), ratio(1));
}

}  // namespace relievo::pipeline

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/board/corner_model.h"

#include <algorithm>
#include <cmath>

#include "hal/base/simd.h"

namespace relievo::pipeline {
namespace {

constexpr std::size_t kLanes = CornerWindow::kLanes;

struct Frame {
  float sin1, cos1, sin2, cos2;
  float width1, width2, per_width1, per_width2;
  float half1, half2, per_pixel1, per_pixel2;  // of a pixel across each edge
  float per_reach;
};

struct Step {
  float value, by_distance, by_width;
};

// The blurred step F is the integral of (1 - u²)⁴, nearly a normal curve of deviation width / 3.3, with
// an end: beyond its width an edge has no say. A pixel collects it over its own breadth, 2 half, as a
// difference of F's integral: a sharp edge is as well placed in it as a soft one.

inline __attribute__((always_inline)) Step step_at(float s, float width, float per_width, float half,
                                                   float per_pixel) {
  constexpr float kScale = 315.F / 128;
  float value[2] = {};
  float integral[2] = {};
  float inner[2] = {};
  for (int k = 0; k < 2; ++k) {
    const float u = (k == 0 ? s + half : s - half) * per_width;
    const float size = u < 0 ? -u : u;
    const float c = size > 1 ? 1.F : size;
    const float r = c * c;
    const float f = kScale * c * (1 + r * (-4.F / 3 + r * (6.F / 5 + r * (-4.F / 7 + r / 9))));
    integral[k] =
        kScale * r * (1.F / 2 + r * (-1.F / 3 + r * (1.F / 5 + r * (-1.F / 14 + r / 90)))) + size - c;
    inner[k] = integral[k] - size * f;
    value[k] = u < 0 ? -f : f;
  }
  return {width * (integral[0] - integral[1]) * per_pixel, (value[0] - value[1]) * per_pixel,
          (inner[0] - inner[1]) * per_pixel};
}

RELIEVO_SIMD void fill_columns(const float* x, const float* y, const float* value, const float* weight,
                               std::size_t count, const float* p, const Frame& f, float* const* out) {
  for (std::size_t i = 0; i < count; ++i) {
    const float dx = x[i] - p[CornerModel::X];
    const float dy = y[i] - p[CornerModel::Y];
    const Step one = step_at(f.cos1 * dy - f.sin1 * dx, f.width1, f.per_width1, f.half1, f.per_pixel1);
    const Step two = step_at(f.sin2 * dx - f.cos2 * dy, f.width2, f.per_width2, f.half2, f.per_pixel2);
    const float q = one.value * two.value;
    const float lx = x[i] * f.per_reach;
    const float ly = y[i] * f.per_reach;
    const float w = weight[i];
    const float swing = p[CornerModel::Swing] + p[CornerModel::SwingX] * lx + p[CornerModel::SwingY] * ly;
    const float by_q = w * (swing + 2 * p[CornerModel::Tone] * q);
    const float by_s1 = by_q * two.value * one.by_distance;
    const float by_s2 = by_q * one.value * two.by_distance;
    out[CornerModel::X][i] = by_s1 * f.sin1 - by_s2 * f.sin2;
    out[CornerModel::Y][i] = by_s2 * f.cos2 - by_s1 * f.cos1;
    out[CornerModel::Angle1][i] = -by_s1 * (f.cos1 * dx + f.sin1 * dy);
    out[CornerModel::Angle2][i] = by_s2 * (f.cos2 * dx + f.sin2 * dy);
    out[CornerModel::Width1][i] = by_q * two.value * one.by_width;
    out[CornerModel::Width2][i] = by_q * one.value * two.by_width;
    out[CornerModel::Light][i] = w;
    out[CornerModel::LightX][i] = w * lx;
    out[CornerModel::LightY][i] = w * ly;
    out[CornerModel::Swing][i] = w * q;
    out[CornerModel::SwingX][i] = w * q * lx;
    out[CornerModel::SwingY][i] = w * q * ly;
    out[CornerModel::Tone][i] = w * q * q;
    const float expected = p[CornerModel::Light] + p[CornerModel::LightX] * lx + p[CornerModel::LightY] * ly +
                           swing * q + p[CornerModel::Tone] * q * q;
    out[CornerModel::Count][i] = w * (value[i] - expected);
  }
}

// Lanes, because the order of a sum is the compiler's only where it is told so.
RELIEVO_SIMD float product(const float* a, const float* b, std::size_t count) {
  float lane[kLanes] = {};
  for (std::size_t i = 0; i < count; i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) lane[k] += a[i + k] * b[i + k];
  float sum = 0;
  for (const float one : lane) sum += one;
  return sum;
}

}  // namespace

void CornerWindow::clear() {
  x.clear();
  y.clear();
  value.clear();
  weight.clear();
  strip.clear();
  count = 0;
}

void CornerWindow::add(float px, float py, float grey, unsigned char part) {
  x.push_back(px);
  y.push_back(py);
  value.push_back(grey);
  weight.push_back(1);
  strip.push_back(part);
  ++count;
}

void CornerWindow::pad() {
  const std::size_t whole = (count + kLanes - 1) / kLanes * kLanes;
  for (auto* column : {&x, &y, &value, &weight}) column->resize(whole, 0.F);
}

void sum_up(const CornerWindow& window, const CornerModel& model, bool information, CornerScratch& scratch,
            CornerSums& sums) {
  constexpr auto kAll = static_cast<std::size_t>(CornerModel::Count) + 1;
  const std::size_t length = window.x.size();
  std::array<float*, kAll> out{};
  for (std::size_t k = 0; k < kAll; ++k) {
    if (scratch.column[k].size() < length) scratch.column[k].resize(length);
    out[k] = scratch.column[k].data();
  }
  const auto& p = model.p;
  Frame f{};
  f.sin1 = std::sin(p[CornerModel::Angle1]), f.cos1 = std::cos(p[CornerModel::Angle1]);
  f.sin2 = std::sin(p[CornerModel::Angle2]), f.cos2 = std::cos(p[CornerModel::Angle2]);
  f.width1 = p[CornerModel::Width1], f.width2 = p[CornerModel::Width2];
  f.per_width1 = 1 / f.width1, f.per_width2 = 1 / f.width2;
  f.half1 = std::max(std::abs(f.sin1), std::abs(f.cos1)) / 2,
  f.half2 = std::max(std::abs(f.sin2), std::abs(f.cos2)) / 2;
  f.per_pixel1 = 0.5F / f.half1, f.per_pixel2 = 0.5F / f.half2;
  f.per_reach = 1 / window.reach_px;
  fill_columns(window.x.data(), window.y.data(), window.value.data(), window.weight.data(), length, p.data(),
               f, out.data());
  constexpr auto kResidual = static_cast<std::size_t>(CornerModel::Count);
  for (std::size_t a = 0; a < kResidual; ++a) {
    sums.slope(static_cast<int>(a)) = static_cast<double>(product(out[a], out[kResidual], length));
    for (std::size_t b = a; information && b < kResidual; ++b)
      sums.information(static_cast<int>(a), static_cast<int>(b)) = sums.information(
          static_cast<int>(b), static_cast<int>(a)) = static_cast<double>(product(out[a], out[b], length));
  }
  sums.squared = static_cast<double>(product(out[kResidual], out[kResidual], length));
  sums.strip_mean.fill(0);
  sums.strip_count.fill(0);
  for (std::size_t i = 0; i < window.count; ++i) {
    sums.strip_mean[window.strip[i]] += static_cast<double>(out[kResidual][i]);
    sums.strip_count[window.strip[i]] += 1;
  }
  for (std::size_t k = 0; k < sums.strip_mean.size(); ++k)
    sums.strip_mean[k] /= std::max(sums.strip_count[k], 1.0);
}

}  // namespace relievo::pipeline

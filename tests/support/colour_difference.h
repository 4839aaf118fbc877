// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How different two colours look: CIEDE2000, after G. Sharma, W. Wu, E. N. Dalal: "The CIEDE2000
// color-difference formula", Color Research and Application 30, 2005. Lab under D65.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace relievo::test {

struct Lab {
  double l = 0, a = 0, b = 0;
};

// 0 to 255 a channel, coded as sRGB (IEC 61966-2-1).
inline Lab lab_of(const std::array<double, 3>& srgb) {
  std::array<double, 3> c{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double v = std::clamp(srgb[i], 0.0, 255.0) / 255;
    c[i] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  }
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double x = f((0.4124564 * c[0] + 0.3575761 * c[1] + 0.1804375 * c[2]) / 0.95047);
  const double y = f(0.2126729 * c[0] + 0.7151522 * c[1] + 0.0721750 * c[2]);
  const double z = f((0.0193339 * c[0] + 0.1191920 * c[1] + 0.9503041 * c[2]) / 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

inline double ciede2000(const Lab& one, const Lab& two) {
  constexpr double kPi = std::numbers::pi;
  const auto deg = [](double d) { return d * kPi / 180; };
  const auto seventh = [](double c) {
    return std::sqrt(std::pow(c, 7) / (std::pow(c, 7) + std::pow(25.0, 7)));
  };
  const double mean_c = (std::hypot(one.a, one.b) + std::hypot(two.a, two.b)) / 2;
  const double g = 0.5 * (1 - seventh(mean_c));
  const double a1 = (1 + g) * one.a, a2 = (1 + g) * two.a;
  const double c1 = std::hypot(a1, one.b), c2 = std::hypot(a2, two.b);
  const auto hue = [&](double a, double b) {
    const double h = a == 0 && b == 0 ? 0 : std::atan2(b, a);
    return h < 0 ? h + 2 * kPi : h;
  };
  const double h1 = hue(a1, one.b), h2 = hue(a2, two.b);
  double dh = c1 * c2 == 0 ? 0 : h2 - h1;
  if (dh > kPi) dh -= 2 * kPi;
  if (dh < -kPi) dh += 2 * kPi;
  const double dl = two.l - one.l, dc = c2 - c1, dbig_h = 2 * std::sqrt(c1 * c2) * std::sin(dh / 2);
  const double l = (one.l + two.l) / 2, c = (c1 + c2) / 2;
  double h = h1 + h2;
  if (c1 * c2 != 0) {
    if (std::abs(h1 - h2) <= kPi) h /= 2;
    else h = h < 2 * kPi ? (h + 2 * kPi) / 2 : (h - 2 * kPi) / 2;
  }
  const double t = 1 - 0.17 * std::cos(h - deg(30)) + 0.24 * std::cos(2 * h) +
                   0.32 * std::cos(3 * h + deg(6)) - 0.20 * std::cos(4 * h - deg(63));
  const double turn = deg(30) * std::exp(-std::pow((h * 180 / kPi - 275) / 25, 2));
  const double sl = 1 + 0.015 * (l - 50) * (l - 50) / std::sqrt(20 + (l - 50) * (l - 50));
  const double sc = 1 + 0.045 * c, sh = 1 + 0.015 * c * t;
  const double rt = -std::sin(2 * turn) * 2 * seventh(c);
  return std::sqrt(std::pow(dl / sl, 2) + std::pow(dc / sc, 2) + std::pow(dbig_h / sh, 2) +
                   rt * (dc / sc) * (dbig_h / sh));
}

}  // namespace relievo::test

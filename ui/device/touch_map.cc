// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/device/touch_map.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <sstream>

namespace relievo::ui {
namespace {

constexpr double kLeastScale = 0.25, kMostScale = 4;  // of picture to panel, along either axis

using Row = std::array<double, 3>;
using Normal = std::array<Row, 3>;

double det(const Normal& a) {
  return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
         a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
         a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

// The normal equations of one axis, by Cramer's rule: three unknowns, well scaled (all within 0 to 1).
Row solve(const Normal& normal, const Row& right, double determinant) {
  Row found{};
  for (std::size_t i = 0; i < 3; ++i) {
    Normal a = normal;
    for (std::size_t row = 0; row < 3; ++row) a[row][i] = right[row];
    found[i] = det(a) / determinant;
  }
  return found;
}

// Both singular values of the linear part are those of a panel.
bool is_plausible(const std::array<double, 6>& m) {
  const double a = m[0] * m[0] + m[3] * m[3], d = m[1] * m[1] + m[4] * m[4], b = m[0] * m[1] + m[3] * m[4];
  const double middle = (a + d) / 2, spread = std::sqrt((a - d) * (a - d) / 4 + b * b);
  return std::isfinite(middle + spread) && middle - spread > kLeastScale * kLeastScale &&
         middle + spread < kMostScale * kMostScale;
}

}  // namespace

TouchPoint TouchMap::operator()(TouchPoint at) const {
  const double x = at.x, y = at.y;
  return {float(m[0] * x + m[1] * y + m[2]), float(m[3] * x + m[4] * y + m[5])};
}

Result<TouchFit> fit_touch_map(std::span<const TouchedCross> crosses) {
  if (crosses.size() < 3) return invalid("three crosses are needed");
  Normal normal{};
  Row right_x{}, right_y{};
  for (const TouchedCross& one : crosses) {
    const Row row{one.touched.x, one.touched.y, 1};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) normal[i][j] += row[i] * row[j];
      right_x[i] += row[i] * double(one.cross.x);
      right_y[i] += row[i] * double(one.cross.y);
    }
  }
  const double determinant = det(normal);
  if (determinant < 1e-4)
    return invalid("the touches lie too close together, or on one line: touch the crosses");
  const Row x = solve(normal, right_x, determinant), y = solve(normal, right_y, determinant);
  TouchFit fit;
  fit.map.m = {x[0], x[1], x[2], y[0], y[1], y[2]};
  if (!is_plausible(fit.map.m)) return invalid("no panel is mounted so: touch the crosses");
  double squares = 0;
  for (const TouchedCross& one : crosses) {
    const TouchPoint at = fit.map(one.touched);
    squares += std::pow(double(at.x - one.cross.x), 2) + std::pow(double(at.y - one.cross.y), 2);
  }
  fit.off = std::sqrt(squares / double(crosses.size()));
  fit.mirrored = x[0] * y[1] - x[1] * y[0] < 0;
  const double sign = fit.mirrored ? -1 : 1;
  fit.turned_deg = std::atan2(y[0] - sign * x[1], x[0] + sign * y[1]) * 180 / std::numbers::pi;
  if (fit.off > kMostTouchOff)
    return invalid("the touches do not fit together: one of them was beside its cross");
  return fit;
}

std::string text_of(const TouchMap& map) {
  std::string text = "1";
  for (const double part : map.m) {
    char number[32];
    std::snprintf(number, sizeof number, " %.9g", part);
    text += number;
  }
  return text;
}

Result<TouchMap> parse_touch_map(std::string_view text) {
  std::istringstream in{std::string(text)};
  std::string version, rest;
  TouchMap map;
  in >> version;
  for (double& part : map.m) in >> part;
  if (!in || version != "1" || (in >> rest) || !is_plausible(map.m))
    return invalid("the touch screen's correction cannot be read: the panel is taken as it is");
  return map;
}

}  // namespace relievo::ui

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/expression/eye_sight.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relievo::pipeline {
namespace {

constexpr double kPupilMm = 31.5;               // from the middle of the face; people: 27 to 37
constexpr double kHalfWidthMm = 20, kTopMm = -58, kBottomMm = -6;
constexpr double kSearchRightMm = 7, kHighestMm = -50, kLowestMm = -25;  // where an iris can be
constexpr std::array kRadiiMm{5.4, 5.9, 6.4};
constexpr double kAcrossMm = 1.0;               // to both sides of the edge
constexpr double kSidesMm = 3.0;                // rows above and below the middle that are looked at
constexpr double kGlareShare = 1.35;             // of skin and sclera
constexpr double kScleraShare = 1.1;             // of the skin, where that is dark
constexpr double kBurntOut = 245;

struct Circle { double right = 0, down = 0, radius = 0, contrast = 0; };

// Sclera less iris in one row of the circle: left, right.
std::array<double, 2> sides(const FaceWindow& w, const Circle& c, double row_mm) {
  const double half = std::sqrt(std::max(0.0, c.radius * c.radius - row_mm * row_mm)), y = c.down + row_mm;
  const auto edge = [&](double outside, double inside) {
    const double a = w.between(outside, y), b = w.between(inside, y);
    return (a - b) / std::max(a + b, 1.0);   // the shade of lids and brows falls on both
  };
  return {edge(c.right - half - kAcrossMm, c.right - half + kAcrossMm), edge(c.right + half + kAcrossMm, c.right + half - kAcrossMm)};
}

double contrast(const FaceWindow& w, const Circle& c) {
  double left = 0, right = 0;
  int rows = 0;
  for (double row = -kSidesMm; row <= kSidesMm + 0.01; row += 1, ++rows) {
    const auto [a, b] = sides(w, c, row);
    left += a, right += b;
  }
  return std::min(left, right) / rows;
}

Circle find_iris(const FaceWindow& w, double side) {
  Circle best;
  best.contrast = -1e9;
  const auto look = [&](Circle c) {
    c.contrast = contrast(w, c);
    if (c.contrast > best.contrast) best = c;
  };
  for (double down = kHighestMm; down <= kLowestMm; down += 1)
    for (double right = side * kPupilMm - kSearchRightMm; right <= side * kPupilMm + kSearchRightMm; right += 1)
      for (const double radius : kRadiiMm) look({right, down, radius, 0});
  const Circle rough = best;
  for (double down = -0.5; down <= 0.5; down += 0.5)
    for (double right = -0.5; right <= 0.5; right += 0.5) look({rough.right + right, rough.down + down, rough.radius, 0});
  return best;
}

// The rows about the middle in which both sides are edges.
double aperture(const FaceWindow& w, const Circle& c) {
  const auto seen = [&](double row) {
    const auto [a, b] = sides(w, c, row);
    return (a + b) / 2 > 0.4 * c.contrast && std::min(a, b) > 0.15 * c.contrast;
  };
  double up = 0, down = 0;
  while (up < 0.92 * c.radius && seen(-up)) up += 0.25;
  while (down < 0.92 * c.radius && seen(down)) down += 0.25;
  return up + down;
}

double disc(const FaceWindow& w, const Circle& c) {
  constexpr double kReachMm = 4;
  double sum = 0;
  int count = 0;
  for (double y = -kReachMm; y <= kReachMm; y += 1)
    for (double x = -kReachMm; x <= kReachMm; x += 1)
      if (x * x + y * y <= kReachMm * kReachMm) sum += w.between(c.right + x, c.down + y), ++count;
  return sum / count;
}

}  // namespace

EyeSight measure_eye(const FacePhoto& photo, double side, StageContext& context) {
  EyeSight eye;
  const double middle = side * kPupilMm;
  const FaceWindow w = cut_window(photo, {middle - kHalfWidthMm, middle + kHalfWidthMm, kTopMm, kBottomMm}, context);
  if (w.empty()) return eye;
  eye.known = true;
  const double skin = std::max(1.0, quantile(w, {middle - 8, middle + 14, -18, kBottomMm}, 0.5, context));
  const Circle iris = find_iris(w, side);
  eye.right_mm = iris.right, eye.down_mm = iris.down;
  eye.contrast = iris.contrast;
  eye.aperture_mm = iris.contrast > 0 ? aperture(w, iris) : 0;
  eye.iris = disc(w, iris) / skin;
  eye.brightness = quantile(w, {iris.right - 13, iris.right + 13, iris.down - 8, iris.down + 12}, 0.75, context) / skin;
  const double sclera = quantile(w, {iris.right - 12, iris.right + 12, iris.down - 5, iris.down + 5}, 0.75, context);  // or the glare itself
  const double bright = std::min(kBurntOut, kGlareShare * std::clamp(sclera, skin, kScleraShare * skin));
  int spots = 0;
  for (int y = std::max(0, static_cast<int>(w.row(iris.down - 8))); y < std::min(w.rows, static_cast<int>(w.row(iris.down + 8))); ++y)
    for (int x = std::max(0, static_cast<int>(w.column(iris.right - 15))); x < std::min(w.columns, static_cast<int>(w.column(iris.right + 15))); ++x)
      spots += static_cast<double>(w.at(x, y)) > bright ? 1 : 0;
  eye.glare_mm2 = spots * FaceWindow::kStepMm * FaceWindow::kStepMm;
  return eye;
}

}  // namespace relievo::pipeline

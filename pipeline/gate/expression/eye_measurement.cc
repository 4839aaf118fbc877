// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/expression/expression_measurement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "pipeline/base/parts.h"

namespace relievo::pipeline {
namespace {

constexpr double kPupilMm = 31.5;  // from the middle of the face; people: 27 to 37
constexpr double kHalfEyeMm = 20, kTopMm = -58, kBottomMm = -6;
constexpr double kSearchRightMm = 7, kHighestMm = -50, kLowestMm = -25;  // where an iris can be
constexpr std::array kRadiiMm{5.4, 5.9, 6.4};
constexpr double kAcrossMm = 1.0;     // to both sides of the edge
constexpr double kSidesMm = 3.0;      // rows above and below the middle that are looked at
constexpr double kGlareShare = 1.35;  // of skin and sclera
constexpr double kScleraShare = 1.1;  // of the skin, where that is dark
constexpr double kBurntOut = 245;
// A lamp that is mirrored in glasses shines before eye and lids alike; sclera and the lamp in a cornea end
// where the lids begin. An eye that looks aside (a ball of 12 mm, by 25 degrees) has its iris beside the
// opening's middle: so far beside the iris the opening may go on.
constexpr double kEyeHalfWidthMm = 13, kEyeHalfHeightMm = 5, kGazeMm = 5;
constexpr double kShineRightMm = 20, kShineDownMm = 14;  // how far about the iris it is looked for
constexpr double kBesideEyeMm2 = 15;
constexpr double kLostShare = 0.5;  // of the other eye's contrast: this one is covered

struct Circle {
  double right = 0, down = 0, radius = 0, contrast = 0;
};

// Sclera less iris in one row of the circle: left, right.
std::array<double, 2> sides(const FaceWindow& w, const Circle& c, double row_mm) {
  const double half = std::sqrt(std::max(0.0, c.radius * c.radius - row_mm * row_mm)), y = c.down + row_mm;
  const auto edge = [&](double outside, double inside) {
    const double a = w.between(outside, y), b = w.between(inside, y);
    return (a - b) / std::max(a + b, 1.0);  // the shade of lids and brows falls on both
  };
  return {edge(c.right - half - kAcrossMm, c.right - half + kAcrossMm),
          edge(c.right + half + kAcrossMm, c.right + half - kAcrossMm)};
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
    for (double right = side * kPupilMm - kSearchRightMm; right <= side * kPupilMm + kSearchRightMm;
         right += 1)
      for (const double radius : kRadiiMm) look({right, down, radius, 0});
  const Circle rough = best;
  for (double down = -0.5; down <= 0.5; down += 0.5)
    for (double right = -0.5; right <= 0.5; right += 0.5)
      look({rough.right + right, rough.down + down, rough.radius, 0});
  return best;
}

// Of the opening of an eye there, behind pieces that shine and go on beyond it, wherever the eye looks.
double shines_before_mm2(const FaceWindow& w, Vec2d eye, float bright, StageContext& context) {
  constexpr double kSampleMm2 = FaceWindow::kStepMm * FaceWindow::kStepMm;
  const auto columns = std::size_t(w.columns);
  const int x0 = int(w.column(eye.x - kShineRightMm)), x1 = int(w.column(eye.x + kShineRightMm));
  const int y0 = int(w.row(eye.y - kShineDownMm)), y1 = int(w.row(eye.y + kShineDownMm));
  const auto shines = [&](std::size_t k) {
    const int x = int(k % columns), y = int(k / columns);
    return x >= x0 && x <= x1 && y >= y0 && y <= y1 && w.grey[k] > bright;
  };
  int sum = 0;
  const auto add_piece = [&](std::span<const std::uint32_t> piece) {
    int within = 0, beyond = 0;
    for (const std::uint32_t k : piece) {
      const double right = std::abs(w.right_mm(int(k % columns)) - eye.x),
                   v = (w.down_mm(int(k / columns)) - eye.y) / kEyeHalfHeightMm, u = right / kEyeHalfWidthMm,
                   least = std::max(0.0, right - kGazeMm) / kEyeHalfWidthMm;
      if (u * u + v * v < 1) ++within;
      else if (least * least + v * v > 1) ++beyond;
    }
    if (beyond * kSampleMm2 >= kBesideEyeMm2) sum += within;
  };
  std::pmr::vector<std::uint32_t> label(w.grey.size(), 0U, &context.scratch);
  label_parts(
      std::span(label), columns, &context.scratch, shines, [](std::size_t, std::size_t) { return true; },
      add_piece);
  return sum * kSampleMm2;
}

double skin_of(const FaceWindow& w, double side, StageContext& context) {
  const double middle = side * kPupilMm;
  return std::max(1.0, quantile(w, {middle - 8, middle + 14, -18, kBottomMm}, 0.5, context));
}

double glare(const FaceWindow& w, double side, Vec2d eye, StageContext& context) {
  const double skin = skin_of(w, side, context),
               sclera = quantile(w, {eye.x - 12, eye.x + 12, eye.y - 5, eye.y + 5}, 0.75,
                                 context);  // or the glare itself
  const double bright = std::min(kBurntOut, kGlareShare * std::clamp(sclera, skin, kScleraShare * skin));
  return shines_before_mm2(w, eye, float(bright), context);
}

EyeMeasurement measure_eye(const FaceWindow& w, double side, StageContext& context) {
  EyeMeasurement eye;
  if (w.empty()) return eye;
  eye.known = true;
  const double skin = skin_of(w, side, context);
  const Circle iris = find_iris(w, side);
  eye.right_mm = iris.right, eye.down_mm = iris.down;
  eye.contrast = iris.contrast;
  eye.brightness =
      quantile(w, {iris.right - 13, iris.right + 13, iris.down - 8, iris.down + 12}, 0.75, context) / skin;
  return eye;
}

}  // namespace

std::array<EyeMeasurement, 2> measure_eyes(const FacePhoto& photo, StageContext& context) {
  constexpr std::array kSides{-1.0, 1.0};
  const auto window = [&](double side) {
    return cut_window(photo, {side * kPupilMm - kHalfEyeMm, side * kPupilMm + kHalfEyeMm, kTopMm, kBottomMm},
                      context);
  };
  const std::array windows{window(kSides[0]), window(kSides[1])};
  std::array<EyeMeasurement, 2> eyes;
  for (std::size_t i = 0; i < 2; ++i) eyes[i] = measure_eye(windows[i], kSides[i], context);
  for (std::size_t i = 0; i < 2; ++i) {
    if (!eyes[i].known) continue;
    const EyeMeasurement &eye = eyes[i], &other = eyes[1 - i];
    const bool covered = other.known && eye.contrast < kLostShare * other.contrast;
    // Both eyes of a head are at one height, which the better seen one tells.
    const double down = other.known && eye.contrast < other.contrast ? other.down_mm : eye.down_mm;
    eyes[i].glare_mm2 =
        glare(windows[i], kSides[i], {covered ? -other.right_mm : eye.right_mm, down}, context);
  }
  return eyes;
}

}  // namespace relievo::pipeline

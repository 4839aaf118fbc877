// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/head/shape/head_field.h"

namespace relievo::hal::sim {
namespace {

double brow_and_orbit(const HeadTraits& t, double ax, Vec3 p) {
  const double eye_x = t.intercanthal / 2 + t.eye_fissure / 2;
  double h = 0;
  h -= (6.2 + 0.8 * t.eye_depth) * bell(ax - (eye_x - 2), 16, p.y - 0.5, 10.5);
  h -= 5.2 * bell(ax - 15, 7.5, p.y - 3.5, 9.5);  // beside the root of the nose
  h += (1.8 + 0.9 * t.brow_ridge) * bell(ax - 22, 17, p.y - (16.5 + 0.12 * ax), 7);
  h += (0.8 + 0.3 * t.brow_ridge) * bell(ax - 44, 9, p.y - 15, 9);  // outer end of the brow
  h += 0.8 * bell(p.x, 11, p.y - 21, 9);
  h += 1.5 * bell(ax - 28, 18, p.y - 55, 17);                    // frontal eminences
  h -= 2.2 * bell({ax - 70, p.y - 18, p.z - 58}, {20, 24, 24});  // temples
  const double crease = 0.9 * t.age * t.age;                     // lines of the forehead
  for (const double y : {35.0, 44.0, 53.5})
    h -= 0.45 * crease *
         bell(ax, 34, p.y - y - 2.5 * std::sin(p.x * 0.05 + y) - 1.4 * std::cos(p.x * 0.11), 1.3);
  h -= 0.5 * crease * bell(ax - 5.5, 1.2, p.y - 17, 7);  // between the brows
  return h;
}

double cheek(const HeadTraits& t, double ax, Vec3 p) {
  const double sn = subnasale_y(t), sto = stomion_y(t);
  double h = 0;
  h += (2.6 + 1.2 * t.cheekbone) * bell({ax - 50, p.y + 24, p.z - 72}, {17, 11, 24});
  h += (1.8 + 0.8 * t.fullness) * bell(ax - 33, 15, p.y + 30, 14);
  h += (0.3 + 2.4 * t.fullness - 1.0 * t.cheekbone) * bell({ax - 50, p.y - sto - 6, p.z - 68}, {18, 18, 24});
  h += 1.0 * bell({ax - 54, p.y - sto + 3, p.z - 26}, {14, 18, 20});  // masseter
  // The nasolabial fold: from beside the wing to beyond the corner of the mouth.
  const Vec3 top{t.nose_width / 2 + 1.5, sn + 11, 0}, low{t.mouth_width / 2 + 6, sto + 2, 0};
  const Vec3 along = low - top, from{ax - top.x, p.y - top.y, 0};
  const double s = dot(from, along) / dot(along, along);
  const double side = (from.x * -along.y + from.y * along.x) / length(along);  // + towards the cheek
  const double bowed = side - 3.2 * (0.25 - (s - 0.5) * (s - 0.5));
  const double reach = smoothstep(-0.22, 0.12, s) * (1 - smoothstep(0.65, 1.15, s));
  h += reach * (-(0.35 + 0.75 * t.age) * gauss(bowed / 3.4) + (0.5 + 0.8 * t.age) * gauss((bowed - 8) / 7.5));
  // Tear trough and the soft edge of the lower lid.
  const double eye_x = t.intercanthal / 2 + t.eye_fissure / 2;
  const double trough_y = -12.5 + 0.010 * (ax - eye_x) * (ax - eye_x);
  h -= (0.6 + 0.6 * t.age) * bell(ax - eye_x + 6, 11, p.y - trough_y, 3.0);
  h += (0.25 + 0.5 * t.age) * bell(ax - eye_x + 1, 11, p.y - trough_y - 5, 3.0);
  return h;
}

double lower_face(const HeadTraits& t, double ax, Vec3 p) {
  const double sn = subnasale_y(t), sto = stomion_y(t), gn = gnathion_y(t);
  const double half = t.mouth_width / 2;
  double h = 0;
  h += 3.4 * bell(ax, 23, p.y - sto - 1, 17);                       // the teeth behind
  h -= 2.8 * bell(ax, 21, p.y - (sto - 0.36 * t.lower_face), 5.5);  // mentolabial furrow
  h += (2.6 + 1.2 * t.chin) * bell(ax, 17 + 2 * t.chin_breadth, p.y - gn - 13, 10);
  h -= 0.18 * (0.3 + t.masculine) * bell(ax, 2.2, p.y - gn - 9, 7);  // cleft
  h -= 1.7 * bell(ax - half - 1.5, 4.5, p.y - sto, 4.5);             // corners of the mouth
  h += 1.0 * bell(ax - half - 7, 4.5, p.y - sto - 1, 8);
  const double philtrum = smoothstep(sn + 1, sn - 4, p.y) * smoothstep(sto + 5, sto + 9, p.y);
  const double column = 3.6 + 2.2 * clamp01((sn - p.y) / t.upper_lip);
  h += philtrum * (-0.28 * gauss(p.x / 3.0) + 0.28 * gauss((ax - column) / 2.2));
  return h;
}

}  // namespace

double stroke_height(const HeadTraits& t, Vec3 p) {
  if (p.z < 5 || p.y < -150) return 0;
  const double ax = std::abs(p.x);
  const double h =
      (p.y > -30 ? brow_and_orbit(t, ax, p) : 0) + (p.y < 15 ? cheek(t, ax, p) + lower_face(t, ax, p) : 0);
  return h * smoothstep(5, 35, p.z);
}

Curve::Curve(std::initializer_list<Knot> knots) : knots_(knots), slopes_(knots.size()) {
  const std::size_t n = knots_.size();
  const auto chord = [&](std::size_t i) {
    return (knots_[i + 1].y - knots_[i].y) / (knots_[i + 1].x - knots_[i].x);
  };
  slopes_.front() = chord(0);
  slopes_.back() = chord(n - 2);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = knots_[i].x - knots_[i - 1].x, after = knots_[i + 1].x - knots_[i].x;
    slopes_[i] = (chord(i - 1) * after + chord(i) * before) / (before + after);
  }
}

double Curve::operator()(double x) const {
  if (x <= knots_.front().x) return knots_.front().y + slopes_.front() * (x - knots_.front().x);
  if (x >= knots_.back().x) return knots_.back().y + slopes_.back() * (x - knots_.back().x);
  std::size_t i = 0;
  while (x > knots_[i + 1].x) ++i;
  const double h = knots_[i + 1].x - knots_[i].x, t = (x - knots_[i].x) / h;
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * knots_[i].y + (t3 - 2 * t2 + t) * h * slopes_[i] +
         (3 * t2 - 2 * t3) * knots_[i + 1].y + (t3 - t2) * h * slopes_[i + 1];
}

BeadString::BeadString(std::initializer_list<Bead> beads, int pieces_between) {
  const std::vector<Bead> b(beads);
  const std::size_t n = b.size();
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Bead &p0 = b[i == 0 ? 0 : i - 1], &p1 = b[i], &p2 = b[i + 1], &p3 = b[std::min(i + 2, n - 1)];
    for (int k = 0; k < pieces_between; ++k) {
      const double t = double(k) / pieces_between, t2 = t * t, t3 = t2 * t;
      const auto through = [&](auto v0, auto v1, auto v2, auto v3) {  // Catmull-Rom
        return (v1 * 2.0 + (v2 - v0) * t + (v0 * 2.0 - v1 * 5.0 + v2 * 4.0 - v3) * t2 +
                (v1 * 3.0 - v0 - v2 * 3.0 + v3) * t3) *
               0.5;
      };
      beads_.push_back(
          {through(p0.at, p1.at, p2.at, p3.at), through(p0.radius, p1.radius, p2.radius, p3.radius)});
    }
  }
  beads_.push_back(b.back());
}

double BeadString::distance(Vec3 p) const {
  double best = 1e9;
  for (std::size_t i = 0; i + 1 < beads_.size(); ++i)
    best = std::min(best, tapered(p, beads_[i], beads_[i + 1]));
  return best;
}

}  // namespace relievo::hal::sim

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/head/shape/form.h"

namespace relievo::hal::sim {

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

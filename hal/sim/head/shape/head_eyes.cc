// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/head/shape/head_field.h"

namespace relievo::hal::sim {

EyeForm::EyeForm(const HeadTraits& traits, const SkullForm& skull) : t_(traits) {
  half_fissure_ = t_.eye_fissure / 2;
  middle_x_ = t_.intercanthal / 2 + half_fissure_;
  const double apex = skull.front_z(middle_x_, 0) - 0.6 - 0.9 * t_.eye_depth;
  centre_ = {middle_x_ + 0.4, 0, apex - radius()};
}

// The highest point lies towards the nose, the lowest towards the ear.
double EyeForm::raised_lid(double s) const {
  const double c = std::clamp(s, -1.0, 1.0), q = c + 0.16 * (1 - c * c);
  return (1.2 + 1.1 * t_.eye_tilt) * c - 0.5 +
         (4.4 + 0.6 * t_.eye_open - 0.5 * t_.age) * (1 - std::pow(std::abs(q), 2.1));
}
// Nearly all of the way is the upper lid's.
double EyeForm::upper_lid(double s) const {
  const double open = t_.expression.lids_open, low = lower_lid(s);
  return open >= 1 ? raised_lid(s) : low + open * (raised_lid(s) - low);
}
double EyeForm::lower_lid(double s) const {
  const double c = std::clamp(s, -1.0, 1.0), q = c - 0.14 * (1 - c * c);
  return (1.2 + 1.1 * t_.eye_tilt) * c - 0.5 - (4.9 + 0.3 * t_.eye_open) * (1 - std::pow(std::abs(q), 2.3));
}

Vec3 EyeForm::lid_point(double s, bool upper) const {
  const double x = middle_x_ + s * half_fissure_, y = upper ? upper_lid(s) : lower_lid(s);
  const double shell = radius() + 1.5;
  const double left = shell * shell - (x - centre_.x) * (x - centre_.x) - (y - centre_.y) * (y - centre_.y);
  return {x, y, centre_.z + std::sqrt(std::max(left, 4.0))};
}

double EyeForm::add_to(double field, Vec3 p) const {
  const Vec3 q{std::abs(p.x), p.y, p.z};
  if (std::abs(q.x - middle_x_) > 30 || std::abs(q.y) > 30 || q.z < centre_.z - 26) return field;
  const Vec3 from = q - centre_;
  // Lids: a shell around the ball, a little wider than it so that the corners are covered.
  const double shell = ellipsoid(from, {radius() + 2.8, radius() + 1.1, radius() + 1.1});
  double d = join(field, shell, 8.5);
  const double s = along(q.x);
  const double middle = clamp01(1 - s * s);
  // The fold above the upper lid, and the fullness that hangs over it.
  const double fold = q.y - raised_lid(s) - (3.2 + 0.9 * t_.lid_fold) * (0.45 + 0.55 * middle) - 0.8;
  const double reach = smoothstep(1.35, 0.75, std::abs(s + 0.05));
  // A lid that comes down draws it flat.
  d += reach * mix(0.35, 1, clamp01(t_.expression.lids_open)) *
       (1.05 * gauss(fold / 1.3) - (0.9 + 0.5 * t_.age) * gauss((fold - 3.9) / 3.2));
  const double bag = q.y - lower_lid(s) + 5.0;
  d += reach * (0.18 + 0.25 * t_.age) * gauss(bag / 1.8);
  // The opening.
  double open = std::max(q.y - upper_lid(s), lower_lid(s) - q.y) * 0.9;
  if (std::abs(s) > 1) open = std::max(open, (std::abs(s) - 1) * half_fissure_);
  open = std::max(open, centre_.z - 1.5 - q.z);
  return cut(d, -open, 0.9);
}

}  // namespace relievo::hal::sim

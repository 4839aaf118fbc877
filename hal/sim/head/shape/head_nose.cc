// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/head/shape/head_field.h"

namespace relievo::hal::sim {

NoseForm::NoseForm(const HeadTraits& traits, const SkullForm& skull) : t_(traits) {
  const HeadTraits& t = t_;
  sn_y_ = subnasale_y(t);
  sn_z_ = skull.front_z(0, sn_y_) + 2.2;
  const double rise = 9.2 + 2.0 * t.tip_up;  // of the tip over the base
  tip_ = {0, sn_y_ + rise, sn_z_ + std::sqrt(t.nose_protrusion * t.nose_protrusion - rise * rise)};
  const double r_tip = 8.4 + 0.8 * t.tip_size;
  const double root_z = skull.front_z(0, 5) - 1.5 + 1.5 * t.bridge;
  const Vec3 tip_centre = tip_ - Vec3{0, 0.5, r_tip};
  const Vec3 root{0, 4.5, root_z - 6.0};
  const Vec3 middle = mix(root, tip_centre, 0.42) + Vec3{0, 0, 1.6 + 1.8 * t.hump};
  bridge_ = {Bead{root, 5.2}, Bead{middle, 5.0 + 0.3 * t.bridge}, Bead{tip_centre, r_tip}};
  wall_ = {Bead{{5.0, 2, root_z - 13}, 5.5}, Bead{{0.25 * t.nose_width, sn_y_ + 9.5, sn_z_ - 3.0}, 9.2}};
  ala_ = {t.nose_width / 2 - 4.9, sn_y_ + 6.0, sn_z_ + 0.6};
}

double NoseForm::add_to(double field, Vec3 p) const {
  const Vec3 q{std::abs(p.x), p.y, p.z};
  if (q.x > 34 || q.y > 30 || q.y < sn_y_ - 22 || q.z < 70) return field;
  double nose = join(tapered(p, bridge_[0], bridge_[1]), tapered(p, bridge_[1], bridge_[2]), 3);
  nose = join(nose, tapered(q, wall_[0], wall_[1]), 12);
  // Two domes make the tip; the columella carries it.
  nose = join(nose, length(q - (bridge_[2].at + Vec3{3.0, -0.8, 1.1})) - (bridge_[2].radius - 1.9), 5);
  const Bead carried{tip_ - Vec3{0, 5.5, 6.2}, 3.6}, foot{{0, sn_y_ + 0.8, sn_z_ - 0.6}, 3.0};
  nose = join(nose, tapered(p, carried, foot), 3.5);
  const Bead dome{bridge_[2].at + Vec3{3.5, -0.5, -1}, bridge_[2].radius - 2.4};
  nose = join(nose, tapered(q, dome, {ala_ + Vec3{-1.5, 0.5, 1}, 4.4}), 4);
  double d = join(field, nose, 12);
  // The wing: a thick shell standing off the tip, with its groove behind and above it.
  const Mat3 lean = rotation(0.30, 0.42, -0.16);
  const double wing = ellipsoid(lean * (q - ala_), {4.7, 6.6, 9.2});
  const double rim = std::abs(wing - 1.6);
  d = join(d, wing, 4.5);
  d += 0.55 * gauss(rim / 2.0) * smoothstep(ala_.y - 3.5, ala_.y + 3.5, q.y) *
       smoothstep(-4, 0, q.x - ala_.x + 6) * smoothstep(tip_.z - 4, tip_.z - 12, q.z);
  d += 0.8 * gauss(rim / 2.0) * smoothstep(ala_.z + 1, ala_.z - 5, q.z) *
       smoothstep(sn_y_ + 14, sn_y_ + 8, q.y);
  // Nostrils: narrow towards the tip, opening downwards and outwards.
  const Vec3 hole{0.205 * t_.nose_width, sn_y_ + 2.2, sn_z_ + 7.2};
  const Mat3 turn = rotation(0.62, 0.36, 0.20);
  const double nostril = ellipsoid(turn * (q - hole), {3.1 + 0.05 * (t_.nose_width - 34), 5.8, 5.6});
  return cut(d, -nostril, 2.2);
}

}  // namespace relievo::hal::sim

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/head/shape/head_field.h"

namespace relievo::hal::sim {

// Local frame of the left ear: x away from the head, y up along the ear, z towards the face.
EarForm::EarForm(const HeadTraits& traits, const SkullForm& skull) : size_(traits.ear_height / 61) {
  (void)skull;
  root_ = {traits.face_breadth / 2 - 0.5, -16, 2};
  turn_ = rotation(-0.20, -0.44 - 0.09 * traits.ear_out, 0.0).transposed();
  const auto at = [](double back, double up, double out, double r) { return Bead{{out, up, -back}, r}; };
  helix_ = BeadString({at(10, 1, 1, 1.8), at(4, 8, 2.5, 2.4), at(2.5, 17, 3.5, 2.6), at(8, 28, 4.0, 2.8),
                       at(18, 31.5, 4.2, 2.9), at(28, 26, 4.2, 2.8), at(32, 14, 4.0, 2.6),
                       at(30.5, 0, 3.6, 2.4), at(25.5, -12, 3.0, 2.3), at(18, -22, 2.2, 2.6)},
                      3);
  antihelix_ = BeadString({at(12, 22, 1.6, 2.4), at(19, 15, 2.6, 2.8), at(22.5, 5, 3.4, 3.0),
                           at(20.5, -6, 3.4, 2.9), at(15, -13.5, 3.2, 3.0), at(10.5, -16, 3.2, 2.6)},
                          3);
}

Vec3 EarForm::local(Vec3 p) const { return turn_ * (Vec3{std::abs(p.x), p.y, p.z} - root_) * (1 / size_); }

double EarForm::add_to(double field, Vec3 p) const {
  const double ax = std::abs(p.x);
  if (ax < root_.x - 25 || p.y > 45 || p.y < -75 || p.z > 25 || p.z < -60) return field;
  const Vec3 q = local(p);
  double ear = ellipsoid(q - Vec3{0.8, 5, -16}, {2.2, 25, 15.5});
  ear = join(ear, helix_.distance(q), 2.4);
  ear = join(ear, antihelix_.distance(q), 2.6);
  ear = join(ear, ellipsoid(q - Vec3{1.6, -25.5, -10}, {2.7, 8.5, 8.5}), 6);
  ear = join(ear, ellipsoid(q - Vec3{-3, 2, -12}, {5, 20, 11}), 6);             // the base, into the head
  ear = cut(ear, -ellipsoid(q - Vec3{4.5, -3.5, -11.5}, {6.2, 11, 8.4}), 3.0);  // the bowl
  ear = join(ear, ellipsoid(q - Vec3{3.0, -7, -1.5}, {2.8, 5.2, 3.8}), 3.2);    // tragus
  return join(field, ear * size_, 3.5);
}

}  // namespace relievo::hal::sim

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/head/shape/head_field.h"

namespace relievo::hal::sim {

// The tables are of an average head in head coordinates; traits stretch them.
SkullForm::SkullForm(const HeadTraits& traits) : t_(traits) {
  const HeadTraits& t = t_;
  const double eu = t.head_breadth / 2, zy = t.face_breadth / 2, go = t.jaw_breadth / 2;
  const double sn = subnasale_y(t), sto = stomion_y(t), gn = gnathion_y(t);
  const double cb = 2.2 * t.chin_breadth;
  breadth_ = {{gn - 6, 15 + cb},
              {gn + 2, 27 + cb},
              {gn + 13, 39 + cb},
              {gn + 28, 0.45 * go + 27 + cb / 2},
              {sto + 6, go + 6.5 + t.fullness * 1.2},
              {sn, 0.55 * zy + 0.45 * go + 2.5},
              {-22, zy - 1.0},
              {-4, zy - 1.2},
              {22, 0.45 * zy + 0.55 * eu - 2.5},
              {48, eu - 2},
              {70, eu - 7},
              {95, eu - 24}};
  const double chin = 2.5 * t.chin;
  front_ = {{gn - 6, 87 + chin},
            {gn + 3, 99 + chin},
            {gn + 14, 104.5 + chin},
            {gn + 28, 102 + 0.4 * chin},
            {sto, 105.5},
            {sn - 6, 105.5},
            {sn, 104},
            {-28, 100.5},
            {-14, 98.5},
            {0, 98},
            {9, 101},
            {21, 106.5 + 0.8 * t.brow_ridge},
            {36, 107 + 0.5 * t.forehead},
            {55, 103.5 + 1.2 * t.forehead},
            {75, 95 + 1.2 * t.forehead},
            {95, 78 + t.forehead}};
  widest_z_ = {{gn - 6, 74}, {gn + 14, 58}, {gn + 32, 34}, {sto + 6, 22},
               {sn, 16},     {-10, 9},      {40, 4},       {95, 4}};
  roundness_ = {{gn - 6, 2.05}, {gn + 14, 2.15}, {sto, 2.15}, {sn, 2.2},
                {-10, 2.3},     {20, 2.65},      {55, 2.5},   {95, 2.2}};
}

double SkullForm::front_z(double x, double y) const {
  const double w = breadth_(y), n = roundness_(y), zw = widest_z_(y);
  const double q = std::min(std::abs(x) / w, 0.999);
  return zw + (front_(y) - zw) * std::pow(1 - std::pow(q, n), 1 / n);
}

double SkullForm::loft(Vec3 p) const {
  const double y = std::clamp(p.y, gnathion_y(t_) - 8, 96.0);
  const double w = std::max(breadth_(y), 5.0), zw = widest_z_(y);
  const double dz = p.z - zw;
  const bool before = dz > 0;
  const double depth = before ? front_(y) - zw : zw + t_.head_length - 108;
  const double n = before ? roundness_(y) : 2.1;
  const double rho = std::pow(std::pow(std::abs(p.x) / w, n) + std::pow(std::abs(dz) / depth, n), 1 / n);
  const double r = std::sqrt(p.x * p.x + dz * dz);
  double d = rho > 1e-6 ? r - r / rho : -w;
  d = cut(d, p.y - 88, 30);
  // The lower edge of the jaw rises from the chin to the angle below the ear.
  const double gn = gnathion_y(t_);
  const double jaw = -(p.y - gn) * 0.93 - (p.z - 98) * 0.365;
  return cut(d, jaw - 0.5 + 2.5 * smoothstep(0, 30, std::abs(p.x)), 20);
}

double SkullForm::neck(Vec3 p) const {
  const double gn = gnathion_y(t_);
  const double r = mix(46, 53, t_.masculine);
  const Bead top{{0, gn + 55, 2}, r * 0.98}, bottom{{0, gn - 90, -28}, r * 1.06};
  Vec3 q = p;
  q.x *= 1.02;
  double d = tapered(q, top, bottom);
  const double ax = std::abs(p.x);
  // Sternomastoids run from behind the ear to the pit of the throat.
  const Bead mastoid{{49, gn + 48, -26}, 10}, sternum{{13, gn - 78, 28}, 8};
  d = join(d, tapered({ax, p.y, p.z}, mastoid, sternum), 16);
  const Bead larynx_top{{0, gn - 20, 32}, 11}, larynx{{0, gn - 55, 19 + 4 * t_.masculine}, 12};
  d = join(d, tapered(p, larynx_top, larynx), 20);
  const Bead shoulder_in{{0, gn - 110, -30}, 58}, shoulder_out{{165, gn - 138, -45}, 48};
  return join(d, tapered({ax, p.y, p.z}, shoulder_in, shoulder_out), 40);
}

double SkullForm::distance(Vec3 p) const {
  const double half_length = t_.head_length / 2;
  const Vec3 cranium{0, 40, 106 - half_length};
  double d = ellipsoid(p - cranium, {t_.head_breadth / 2 - 0.5, 80, half_length - 1});
  if (p.y < 112) d = join(d, loft(p), 16);
  if (p.y < -20) d = join(d, neck(p), mix(30, 46, smoothstep(35, 0, p.z)));  // softest below the ear
  return d;
}

}  // namespace relievo::hal::sim

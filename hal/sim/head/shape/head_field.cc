// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/head/shape/head_field.h"

namespace relievo::hal::sim {

// Local frame of the left ear: x away from the head, y up along the ear, z towards the face.
EarForm::EarForm(const HeadTraits& traits) : size_(traits.ear_height / 61) {
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

MouthForm::MouthForm(const HeadTraits& traits, const SkullForm& skull) : t_(traits) {
  const double smile = t_.expression.smile;
  half_width_ = t_.mouth_width / 2 * (1 + 0.22 * smile);
  sto_ = stomion_y(t_);
  upper_mm_ = (7.0 + 1.5 * t_.lip_fullness) * (1 - 0.25 * smile);  // drawn out, lips are thinner
  lower_mm_ = (9.0 + 1.6 * t_.lip_fullness) * (1 - 0.2 * smile);
  bow_ = {{0, 0.84}, {0.11, 0.90}, {0.21, 1.0}, {0.33, 0.92}, {0.6, 0.60}, {0.85, 0.24}, {1, 0.02}};
  front_ = skull.front_z(0, sto_) + 3.4;
  const double w = half_width_, u = upper_mm_, l = lower_mm_;
  // Follows the arch of the teeth behind.
  const auto arch = [&](double x, double y, double out, double r) {
    const double z = skull.front_z(x, y) + 3.4 * gauss(x / 23) + out - r;
    return Bead{{x, y, z}, r};
  };
  const double g = 0.25 * t_.lip_fullness;
  upper_ =
      BeadString({arch(-6, sto_ + 0.47 * u, 1.5 + g, 3.6), arch(0, sto_ + 0.36 * u, 2.0 + g, 3.5),
                  arch(6, sto_ + 0.47 * u, 1.5 + g, 3.6), arch(0.55 * w, sto_ + 0.31 * u, 1.0 + g, 3.0),
                  arch(0.8 * w, line_y(0.8 * w) + 0.12 * u, 0.5, 2.0), arch(w - 0.5, line_y(w), -0.9, 1.0)},
                 3);
  lower_ =
      BeadString({arch(-8, sto_ - 0.46 * l, 1.5 + g, 4.3), arch(0, sto_ - 0.46 * l, 1.4 + g, 4.4),
                  arch(8, sto_ - 0.46 * l, 1.5 + g, 4.3), arch(0.55 * w, sto_ - 0.38 * l, 0.8 + g, 3.6),
                  arch(0.8 * w, line_y(0.8 * w) - 0.20 * l, 0.1, 2.4), arch(w - 0.5, line_y(w), -1.1, 1.0)},
                 3);
  line_ = BeadString({arch(-6, line_y(6), 1.5, 0.7), arch(0, line_y(0), 1.7, 0.7),
                      arch(6, line_y(6), 1.5, 0.7), arch(0.5 * w, line_y(0.5 * w), 0.9, 0.7),
                      arch(0.8 * w, line_y(0.8 * w), 0.2, 0.6), arch(w + 0.3, line_y(w + 0.3), -0.2, 0.4)},
                     3);
}

double MouthForm::line_y(double x) const {
  const double s = std::abs(x) / half_width_;
  // A small dip in the middle, and corners that go their person's way.
  return sto_ - 0.7 * gauss(s / 0.2) + 0.35 * gauss((s - 0.33) / 0.2) +
         (-0.6 + 1.1 * t_.mouth_curve + 5.5 * t_.expression.smile) * s * s;
}

double MouthForm::upper_edge(double x) const {
  const double s = std::min(std::abs(x) / half_width_, 1.0);
  return line_y(x) + upper_mm_ * bow_(s);
}

double MouthForm::lower_edge(double x) const {
  const double s = std::min(std::abs(x) / half_width_, 1.0);
  return line_y(x) - lower_mm_ * std::pow(1 - s * s, 0.75) * (1 - 0.12 * gauss(s / 0.15));
}

double MouthForm::vermilion(Vec3 p) const {
  if (std::abs(p.x) > half_width_ + 1 || p.z < front_ - 30) return 0;
  const double up = upper_edge(p.x) - p.y, low = p.y - lower_edge(p.x);
  return smoothstep(-0.8, 1.2, up) * smoothstep(-1.3, 2.0, low) *
         smoothstep(half_width_ + 0.5, half_width_ - 5.0, std::abs(p.x));
}

double MouthForm::dropped(double x, double z) const {
  const double s = std::abs(x) / half_width_;
  return s < 1 ? t_.expression.jaw_mm * (1 - s * s) * smoothstep(-10, 80, z) : 0;
}

Vec3 MouthForm::closed(Vec3 p) const {
  const double jaw = t_.expression.jaw_mm;
  if (jaw <= 0) return p;
  const double line = line_y(std::min(std::abs(p.x), half_width_)), below = line - p.y;
  if (below <= 0) return p;
  const double lip = dropped(p.x, p.z);
  if (below < lip) return {p.x, line, p.z};
  // Beside and below the lip the skin stretches until it has gone as far as the chin, then back on the neck.
  const double chin = jaw * smoothstep(-10, 80, p.z), gn = gnathion_y(t_) - jaw;
  return {p.x, p.y + mix(lip, chin, smoothstep(0, 34, below - lip)) * smoothstep(gn - 70, gn - 8, p.y), p.z};
}

double MouthForm::gape(Vec3 p) const {
  const double line = line_y(std::min(std::abs(p.x), half_width_)), lip = dropped(p.x, p.z);
  if (lip < 0.3) return 10;
  return std::max(
      {0.9 * (p.y - line), 0.9 * (line - lip - p.y), std::abs(p.x) - half_width_, front_ - 30 - p.z});
}

double MouthForm::add_to(double field, Vec3 p) const {
  const Vec3 q{std::abs(p.x), p.y, p.z};
  if (q.x > half_width_ + 12 || std::abs(q.y - sto_) > 24 || q.z < front_ - 36) return field;
  const double lips = join(upper_.distance(q), lower_.distance(q), 0.7);
  double d = join(field, lips, 4.2);
  d = cut(d, -line_.distance(q), 1.6);
  // The white roll that borders the vermilion.
  d -= 0.22 * gauss((q.y - upper_edge(q.x) - 0.5) / 0.8) * smoothstep(half_width_, half_width_ - 7, q.x);
  return d;
}

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
  wing_turn_ = rotation(0.30, 0.42, -0.16);
  nostril_turn_ = rotation(0.62, 0.36, 0.20);
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
  const double wing = ellipsoid(wing_turn_ * (q - ala_), {4.7, 6.6, 9.2});
  const double rim = std::abs(wing - 1.6);
  d = join(d, wing, 4.5);
  d += 0.55 * gauss(rim / 2.0) * smoothstep(ala_.y - 3.5, ala_.y + 3.5, q.y) *
       smoothstep(-4, 0, q.x - ala_.x + 6) * smoothstep(tip_.z - 4, tip_.z - 12, q.z);
  d += 0.8 * gauss(rim / 2.0) * smoothstep(ala_.z + 1, ala_.z - 5, q.z) *
       smoothstep(sn_y_ + 14, sn_y_ + 8, q.y);
  // Nostrils: narrow towards the tip, opening downwards and outwards.
  const Vec3 hole{0.205 * t_.nose_width, sn_y_ + 2.2, sn_z_ + 7.2};
  const double nostril = ellipsoid(nostril_turn_ * (q - hole), {3.1 + 0.05 * (t_.nose_width - 34), 5.8, 5.6});
  return cut(d, -nostril, 2.2);
}

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

Vec3 HeadField::swayed(Vec3 p) const {
  // No face is symmetric: two slow waves move its sides by up to a millimetre or so.
  return {p.x + 0.8 * std::sin(p.y * 0.021 + sway_a_), p.y + 0.7 * std::sin(p.x * 0.035 + sway_b_),
          p.z + 0.6 * std::sin(p.x * 0.03 + p.y * 0.02 + sway_a_ + sway_b_)};
}

Vec3 HeadField::warped(Vec3 p) const { return mouth.closed(swayed(p)); }

double HeadField::distance(Vec3 point) const {
  const Vec3 leaning = swayed(point), p = mouth.closed(leaning);
  double d = skull.distance(p);
  if (d > 45) return d;
  if (d < 22) d -= stroke_height(traits, p);
  d = nose.add_to(d, p);
  d = mouth.add_to(d, p);
  d = eye.add_to(d, p);
  if (traits.ripple_mm != 0)
    d -= traits.ripple_mm * std::sin(6.283185307179586 * point.x / traits.ripple_wave_mm);
  d = ear.add_to(d, p);
  return traits.expression.jaw_mm > 0 ? cut(d, -mouth.gape(leaning), 1.2) : d;
}

Vec3 HeadField::gradient(Vec3 p) const {
  constexpr double e = 0.08;  // mm; four corners of a tetrahedron do for three differences
  const double a = distance({p.x + e, p.y - e, p.z - e}), b = distance({p.x - e, p.y - e, p.z + e});
  const double c = distance({p.x - e, p.y + e, p.z - e}), d = distance({p.x + e, p.y + e, p.z + e});
  return normalised({a - b - c + d, c + d - a - b, b + d - a - c});
}

}  // namespace relievo::hal::sim

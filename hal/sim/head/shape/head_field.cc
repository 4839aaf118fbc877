// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/head/shape/head_field.h"

#include "hal/sim/base/noise.h"

namespace relievo::hal::sim {

HeadField::HeadField(const HeadTraits& t)
    : traits(t), skull(t), strokes(t), nose(t, skull), mouth(t, skull), eye(t, skull), ear(t, skull) {}

Vec3 HeadField::swayed(Vec3 p) const {
  // No face is symmetric: two slow waves move its sides by up to a millimetre or so.
  const double a = unit_from_hash(hash_cell(1, 2, 3, traits.seed)) * 6.28,
               b = unit_from_hash(hash_cell(4, 5, 6, traits.seed)) * 6.28;
  return {p.x + 0.8 * std::sin(p.y * 0.021 + a), p.y + 0.7 * std::sin(p.x * 0.035 + b),
          p.z + 0.6 * std::sin(p.x * 0.03 + p.y * 0.02 + a + b)};
}

Vec3 HeadField::warped(Vec3 p) const { return mouth.closed(swayed(p)); }

double HeadField::distance(Vec3 point) const {
  const Vec3 leaning = swayed(point), p = mouth.closed(leaning);
  double d = skull.distance(p);
  if (d > 45) return d;
  if (d < 22) d -= strokes.height(p);
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

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/head_landmarks.h"

namespace relievo::hal::sim {
namespace {

// Where the sculpture's point has gone in this leaning face.
Vec3 leaned(const HeadField& field, Vec3 sculpted) {
  Vec3 p = sculpted;
  for (int k = 0; k < 6; ++k) p = p - (field.warped(p) - sculpted);
  return p;
}

// The foremost skin at (x, y) of the sculpture; z from well before the face backwards.
Vec3 skin_at(const HeadField& field, double x, double y) {
  double z = 150;
  for (int k = 0; k < 400 && z > 40; ++k) {
    const double d = field.distance(leaned(field, {x, y, z}));
    if (d < 0.01) break;
    z -= 0.5 * std::min(d, 2.0);
  }
  return {x, y, z};
}

// Of the profile between two heights, the point furthest along (sign 1) or against the direction (dy, dz).
Vec3 extreme(const HeadField& field, double from_y, double to_y, double dy, double dz) {
  Vec3 best;
  double most = -1e9;
  constexpr double kStepMm = 0.1;
  const int steps = static_cast<int>((to_y - from_y) / kStepMm + 1e-9);
  for (int i = 0; i <= steps; ++i) {
    const Vec3 p = skin_at(field, 0, from_y + kStepMm * i);
    if (const double along = dy * p.y + dz * p.z; along > most) most = along, best = p;
  }
  return best;
}

}  // namespace

std::vector<HeadLandmark> landmarks_of(const HeadField& field) {
  const HeadTraits& t = field.traits;
  const double sn = subnasale_y(t), gn = gnathion_y(t);
  const Vec3 tip = extreme(field, sn + 2, sn + 20, 0, 1);
  const Vec3 lip = extreme(field, stomion_y(t) + 2, sn - 5, 0, 1);
  // Subnasale: the corner furthest behind the chord from the nose's tip to the lip.
  const Vec3 chord = normalised(tip - lip);
  const Vec3 base = extreme(field, lip.y, tip.y - 3, chord.z, -chord.y);
  const Vec3 brow = extreme(field, 18, 45, 0, 1);
  std::vector<HeadLandmark> all{{"pronasale", tip},
                                {"nasion", extreme(field, tip.y + 15, brow.y, 0, -1)},
                                {"subnasale", base},
                                {"pogonion", extreme(field, gn, gn + 26, 0, 1)}};
  const double inner = t.intercanthal / 2, outer = inner + t.eye_fissure;
  for (const double side : {-1.0, 1.0}) {
    const auto add = [&](std::string_view right, std::string_view left, Vec3 at) {
      all.push_back({side < 0 ? right : left, {side * at.x, at.y, at.z}});
    };
    add("endocanthion_right", "endocanthion_left", skin_at(field, inner - 0.5, field.eye.upper_lid(-1)));
    add("exocanthion_right", "exocanthion_left", skin_at(field, outer + 0.5, field.eye.upper_lid(1)));
    const double w = field.mouth.half_width();
    add("cheilion_right", "cheilion_left", skin_at(field, w, field.mouth.line_y(w)));
  }
  for (HeadLandmark& l : all) l.at = leaned(field, l.at);
  return all;
}

}  // namespace relievo::hal::sim

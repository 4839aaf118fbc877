// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/target/speckle.h"

#include <array>

#include "hal/sim/base/noise.h"

namespace relievo::hal::sim {
namespace {

constexpr double kPaper = 0.72, kInk = 0.07;

// 1 inside a dot. Each cell holds a ball of ink whose size its own hash says.
double dots(Vec3 p_mm, double cell_mm, std::uint32_t seed) {
  const NearestDot near = nearest_dot(p_mm * (1 / cell_mm), seed);
  const double radius = 0.24 + 0.22 * unit_from_hash(near.hash * 747796405U + 1);
  const double soft = 0.12 / cell_mm;  // sprayed ink has soft edges
  return 1 - smoothstep(radius - soft, radius + soft, near.distance);
}

struct Lamp {
  Vec3 centre_mm;
  double power = 0;
};
constexpr std::array<Lamp, 2> kLamps{Lamp{{-330, -190, 40}, 0.62}, Lamp{{470, -200, 60}, 0.46}};
constexpr double kReferenceMm = 640;  // where a lamp's power is what it says

}  // namespace

double speckle(Vec3 p, std::uint32_t seed) {
  const double ink = std::max({dots(p, 0.9, seed), dots(p, 1.4, seed + 57), dots(p, 4.1, seed + 101)});
  return mix(kPaper, kInk, ink) * (1 + 0.06 * value_noise(p * 0.09, seed + 7));
}

double matt_light(Vec3 p, Vec3 normal) {
  double light = 0.16 + 0.05 * -normal.y;  // the room, a little more of it from above
  for (const Lamp& lamp : kLamps) {
    const Vec3 to = lamp.centre_mm - p;
    const double d = length(to);
    // A lamp a quarter of a metre wide sets gently: the terminator is soft.
    const double lit = std::max(0.0, (dot(normal, to) / d + 0.15) / 1.15);
    light += lamp.power * lit * (kReferenceMm / d) * (kReferenceMm / d);
  }
  return light;
}

Vec3 dark_room(Vec3 direction) {
  const double grey = 0.03 + 0.006 * value_noise(direction * 6, 99) - 0.015 * direction.y;
  return {grey, grey * 1.02, grey * 1.05};
}

}  // namespace relievo::hal::sim

// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/base/noise.h"
#include "hal/sim/optics/scene.h"

namespace relievo::hal::sim {
namespace {

constexpr Vec3 kAim{20, -10, 560};

Panel panel_at(Vec3 centre, double half_wide, double half_high, double power) {
  const Vec3 n = normalised(kAim - centre), x = normalised(cross(Vec3{0, 1, 0}, n)), y = cross(n, x);
  return {centre, x * half_wide, y * half_high, power};
}

// A panel of 21.5 inches under the cameras, tilted to the face. White of 300 cd/m2 on 0.128 m2 gives 93 lx at
// the reference distance; 1 is 1000 lx: the dim room's 0.1 is 100 lx.
constexpr double kScreenHalfWide = 238, kScreenHalfHigh = 134, kScreenWhite = 0.093;

}  // namespace

Result<void> HeadLighting::check() const {
  for (const double power : {left, right, below, screen})
    if (!(power >= 0) || !(power <= 10)) return invalid("a lamp is 0 to 10 times as bright as usual");
  return {};
}

std::array<Panel, kPanels> lamp_panels(const HeadLighting& lighting) {
  return {panel_at({-330, -190, 40}, 130, 130, 0.80 * lighting.left),
          panel_at({470, -200, 60}, 130, 130, 0.42 * lighting.right),
          panel_at({80, 420, 60}, 120, 120, 0.10 * lighting.below),
          panel_at({70, 180, 0}, kScreenHalfWide, kScreenHalfHigh, kScreenWhite * lighting.screen)};
}

Vec3 room_light(Vec3 direction) {
  const double grey = 0.035 + 0.010 * value_noise(direction * 6, 99) - 0.02 * direction.y;
  return {grey, grey * 1.02, grey * 1.06};
}

}  // namespace relievo::hal::sim
